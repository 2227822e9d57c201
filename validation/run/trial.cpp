// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/trial.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/reference.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/run/run_one.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// A folder of our own for jobs that are only asked about.
class Scratch {
 public:
  Scratch() {
    std::string path = (fs::temp_directory_path() / "tripoint-check-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr)
      throw EngineError(path + ": no folder for the jobs that engines are asked about could be made");
    path_ = path;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool known(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// An error of a metric's own words comes with its place; one of a reference with none.
Finding finding_of(const InputError& e, const MetricChoice& m) {
  const std::string what = e.what(), place = to_string(e.place()) + ": ";
  const bool placed = !e.place().file.empty() && what.starts_with(place);
  return {true, placed ? what.substr(place.size()) : fmt::format("metric \"{}\": {}", m.name, what),
          placed ? e.place() : m.place};
}

/// Words of the judge, which the scene does not know: a name that nobody evaluates would pass silently.
void check_words(const Case& c, std::vector<Finding>& findings) {
  const auto quantities = names_of(metric_quantities()), functions = names_of(reference_functions());
  for (const auto& m : c.metrics) {
    const auto refuse = [&](const char* what, const std::string& word, const std::vector<std::string>& list) {
      if (!known(list, word))
        findings.push_back({true,
                            fmt::format("metric \"{}\": no {} is named \"{}\"{}", m.name, what,
                                        printable(word), suggestion(word, list)),
                            m.place});
    };
    if (!m.quantity.starts_with("ledger.")) refuse("quantity", m.quantity, quantities);
    if (m.reference && !m.reference->function.empty())
      refuse("reference function", m.reference->function, functions);
  }
  if (!c.reference.function.empty() && !known(functions, c.reference.function))
    findings.push_back(
        {true,
         fmt::format("no reference function is named \"{}\"{}", printable(c.reference.function),
                     suggestion(c.reference.function, functions)),
         {c.file, 0, 0}});
}

/// A term that no engine of ours keeps is a warning: another engine may keep it.
void check_ledger_terms(const Case& c, std::vector<Finding>& findings) {
  std::vector<std::string> terms{"residual"};
  for (const LedgerEntry& entry : ledger_entries()) terms.emplace_back(entry.name);
  for (const auto& m : c.metrics) {
    const std::string term = m.quantity.starts_with("ledger.") ? m.quantity.substr(7) : "";
    if (!term.empty() && !known(terms, term))
      findings.push_back({false,
                          fmt::format("metric \"{}\": the ledger has no term \"{}\"{}", m.name,
                                      printable(term), suggestion(term, terms)),
                          m.place});
  }
}

/// The start as a frame at a later time.
Snapshot still_frame(const Job& job, const InitialState& initial, double time) {
  Snapshot s;
  s.time = time;
  s.position = initial.position;
  s.velocity = initial.velocity;
  s.mass = initial.mass;
  s.temperature = initial.temperature;
  s.phase = initial.phase;
  s.body = initial.body;
  s.material = initial.material;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    s.id.push_back(static_cast<int>(i));
    s.density.push_back(job.scene.materials.at(static_cast<std::size_t>(initial.material[i])).density);
    s.liquid_fraction.push_back(initial.phase[i] == static_cast<int>(Phase::liquid) ? 1.0 : 0.0);
  }
  s.pressure.assign(initial.size(), 0.0);
  for (const JobBody& b : job.bodies)
    if (b.index >= 0)
      s.bodies.push_back(
          {b.properties.centre, b.velocity, b.angular_velocity, {}, b.properties.mass, {}, {}});
  return s;
}

/// Output times at which a metric can be tried: both ends, those that it names, and the first and last of its
/// window.
std::vector<double> times_for(const MetricChoice& m, const Job& job) {
  std::set<double> times{job.times.front(), job.times.back()};
  double at = 0.0;
  const bool named = std::from_chars(m.at.data(), m.at.data() + m.at.size(), at).ec == std::errc();
  const bool windowed = m.window[1] > 0.0;
  std::vector<double> inside;
  for (const double t : job.times) {
    if (named && std::abs(t - at) <= 1e-9 * job.times.back()) times.insert(t);
    if (windowed && t >= m.window[0] - 1e-9 * job.times.back() && t <= m.window[1] + 1e-9 * job.times.back())
      inside.push_back(t);
  }
  if (!inside.empty()) times.insert({inside.front(), inside[inside.size() / 2], inside.back()});
  return {times.begin(), times.end()};
}

/// Whether a note tells of the case and not of the particles that stayed where they were.
bool tells_of_the_case(const std::string& note) {
  if (note == "the trajectory has no temperature") return true;
  for (const char* start : {"the reference", "no output time", "only the start", "the front has not started",
                            "mass_in_region needs", "the box follows", "the start has one temperature"})
    if (note.rfind(start, 0) == 0 && note.find("the reference's body") == std::string::npos) return true;
  return false;
}

/// Whether it tells that the metric takes no particle where it looks: none at the start, and perhaps later.
bool looks_at_nothing(const std::string& note) {
  return note.starts_with("no particle that the metric takes lies");
}

/// Particles and their file for each sampling of the case.
class Samples {
 public:
  explicit Samples(fs::path folder) : folder_(std::move(folder)) {}
  struct Sample {
    InitialState state;
    std::string file;
  };
  /// The particles as they are laid: liquids are not let down into equilibrium, for nothing is run here.
  const Sample& of(Scene scene) {
    scene.settle = false;
    const auto [at, fresh] = samples_.try_emplace(sampling_key(scene));
    if (!fresh) return at->second;
    at->second.state = sample(scene);
    at->second.file = (folder_ / fmt::format("particles-{}.h5", samples_.size())).string();
    write_particles(at->second.file, at->second.state);
    return at->second;
  }

 private:
  fs::path folder_;
  std::map<std::string, Sample> samples_;
};

void ask_about(const Case& value, const EnginePlan& engine, const RunPlan& run, const Job& job,
               const Samples::Sample& from, const fs::path& folder, std::vector<Finding>& findings) {
  RunRequest request;
  request.engine = engine.entry;
  request.job = &job;
  request.initial = &from.state;
  request.folder = folder.string();
  request.particles = from.file;
  const Outcome answer = ask(request);
  EngineRow row;
  row.refuses = declared_refusal(engine.settings);
  row.status = answer.status;
  row.reason = answer.reason;
  if (const auto broken = broken_refusal(row); !broken.empty())
    return findings.push_back({true,
                               fmt::format("engine {} {}", label_of(engine.name, engine.preset), broken),
                               {value.file, 0, 0}});
  if (answer.status == Status::ok || refuses_as_expected(row)) return;
  const std::string what = fmt::format("engine {}{}{}: {}: {}", engine.name,
                                       is_default_preset(engine.preset) ? "" : " " + engine.preset,
                                       run.base ? "" : ", run " + run.label, answer.status, answer.reason);
  if (std::none_of(findings.begin(), findings.end(), [&](const Finding& f) { return f.what == what; }))
    findings.push_back({engine.required, what, {value.file, 0, 0}});
}

}  // namespace

std::string with_place(const Finding& f) {
  return (f.place.file.empty() ? "" : to_string(f.place) + ": ") + f.what;
}

std::vector<Finding> try_metrics(const Case& value, const Job& whole, const InitialState& initial) {
  std::vector<Finding> findings;
  for (const MetricChoice& m : value.metrics) {
    Job job = whole;
    job.times = times_for(m, whole);
    Trajectory still;
    for (const double t : job.times) still.frames.push_back(still_frame(job, initial, t));
    try {
      const auto value_of = metric_of(value, m, job, initial, still);
      if (std::isfinite(value_of.value)) continue;
      if (looks_at_nothing(value_of.note))
        findings.push_back(
            {false,
             fmt::format("metric \"{}\": at the start {}: it has no value until one comes there", m.name,
                         value_of.note),
             m.place});
      else if (tells_of_the_case(value_of.note))
        findings.push_back(
            {true, fmt::format("metric \"{}\" could not be formed of any run: {}", m.name, value_of.note),
             m.place});
    } catch (const InputError& e) {
      findings.push_back(finding_of(e, m));
    }
  }
  return findings;
}

std::vector<Finding> trial(const Case& value) {
  std::vector<Finding> findings;
  check_words(value, findings);
  if (!findings.empty()) return findings;
  check_ledger_terms(value, findings);
  std::vector<std::string> names = names_of(value.engines);
  names.emplace_back(engine_name::solver);
  const auto engines = discover_engines_named(names);
  const Scratch scratch;
  Samples samples(scratch.path());
  bool tried = false;
  for (const EnginePlan& plan : plan_runs(value, engines, {})) {
    if (!plan.entry || !plan.entry->available) {
      if (plan.required)
        findings.push_back(
            {true,
             fmt::format("engine {} is required and {}", plan.name,
                         plan.entry ? "is not available: " + plan.entry->reason
                                    : "is not found beside the program or in TRIPOINT_ENGINE_PATH"),
             {value.file, 0, 0}});
      continue;
    }
    for (const RunPlan& run : plan.runs) {
      if (!run.base && !is_own_solver(plan.name)) continue;
      // Another seed: the engine is asked about the run that it repeats
      if (run.label != run.group) continue;
      const Scene scene = scene_of(value, run);
      const auto& from = samples.of(scene);
      const Job job = make_job(value, plan, run, scene, from.state);
      if (!tried)
        for (auto& f : try_metrics(value, job, from.state)) findings.push_back(std::move(f));
      tried = true;
      ask_about(value, plan, run, job, from, scratch.path() / "job", findings);
    }
  }
  return findings;
}

}  // namespace tripoint
