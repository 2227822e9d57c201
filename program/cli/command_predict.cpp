// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/predict_runs.hpp"
#include "program/cli/predict_text.hpp"
#include "program/predict/kit.hpp"
#include "validation/harness/case_names.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/results.hpp"
#include "validation/harness/suite.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace {

constexpr const char* description =
    "Predicts what a step of a case costs on many ranks of the engine tripoint-mpi: time, efficiency, memory. Three short runs "
    "on one rank give\n"
    "the cost of a particle and a pair, a probe of MPI between two ranks gives latency and bandwidth, and the particles are "
    "shared out as the\n"
    "engine would do it. Every table says what is prediction; --measure runs it beside.\n"
    "  tripoint predict heat/cosine-mode --ranks 2,4,64\n"
    "  tripoint predict fluid/dam-break-small --ranks 1024,10240 --particles 1e8,1e9 --machine cluster.toml\n"
    "  tripoint predict heat/cosine-mode --ranks 1,2 --measure 1,2 --set scene.spacing='0.125 mm'   beside what this machine "
    "takes\n"
    "  tripoint predict speed/liquid-heat --measure 1,2 --weak-set 'body.cube.shape.max=[0.34,0.34,0.68]'    as many particles a "
    "rank\n"
    "  tripoint predict heat/cosine-mode --ranks 1,2,4,8 --kit > kit.sh                one file for a cluster: sbatch kit.sh\n"
    "  tripoint predict --compare FILE.json                                            what the kit has brought back\n"
    "A machine file (TOML) has name, cores_a_node, latency (s), bandwidth (bytes/s); where they differ, allreduce (s), pack_rate "
    "(bytes/s),\n"
    "core_speed (of its cores over these), waiting (share of the work, 0.05).\n"
    "Exit: 0 done, 2 bad input, 4 the engine is missing or cannot run the case over ranks.";

/// Particles times ranks up to which shares are counted one by one; beyond, they are scaled by volume.
constexpr double most_counted = 1e9;
constexpr double slow_latency = 1e-4;  ///< [s] of a message between two processes of one machine: fifty times that of a quiet one
constexpr int most_ranks = 1000000, most_measured = 1024;

struct Options {
  std::string what, machine, out, compare;
  std::vector<int> ranks, measure;
  std::vector<double> particles;
  std::vector<std::string> set, larger;
  int repeats = 3;
  double seconds = 1.5;
  bool weak = false, kit = false, quiet = false, json = false;
};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

int compare(const Options& o) {
  const auto document = nlohmann::ordered_json::parse(text_of(o.compare), nullptr, false);
  if (document.is_discarded()) throw InputError(o.compare + ": is no JSON");
  print(o.json ? document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
               : prediction_text(document));
  return exit_pass;
}

void check(const std::vector<int>& list, const char* option, int most) {
  for (const int n : list)
    if (n < 1 || n > most) throw InputError(fmt::format("{} {}: write whole numbers from 1 to {}", option, n, most));
}

/// The runs on one rank: the case, the same coarser, the same with a wider support. The last tells the cost of a pair from that
/// of a particle.
struct OneRankRuns {
  std::vector<Prepared> prepared;
  std::vector<Timed> timed;
};

OneRankRuns time_one_rank(PredictRuns& runs, int repeats, std::vector<std::string>& notes) {
  constexpr double coarser = 2.0, wider = 1.25;
  OneRankRuns all;
  all.prepared.push_back(runs.prepare("case", {}));
  runs.choose_end(all.prepared.front());
  const Scene scene = all.prepared.front().scene;
  const std::vector<std::pair<std::string, std::string>> others{
      {"coarse", fmt::format("scene.spacing={:.17g}", coarser * scene.spacing)},
      {"wide", fmt::format("scene.support_ratio={:.17g}", wider * scene.support_ratio)}};
  for (const auto& [label, set] : others) {
    try {
      Prepared p = runs.prepare(label, {set});
      runs.choose_end(p, all.prepared.front().end);
      all.prepared.push_back(std::move(p));
    } catch (const std::exception& e) {
      notes.push_back(fmt::format("no run with {}: {}", set, e.what()));
    }
    if (interrupted()) return all;
  }
  all.timed.resize(all.prepared.size());
  for (int n = 0; n < repeats; ++n)
    for (std::size_t k = 0; k < all.prepared.size() && !interrupted(); ++k) runs.time(all.prepared[k], all.timed[k]);
  return all;
}

predict::Shares shares_of(const predict::Cloud& cloud, int ranks, double particles, bool& counted) {
  const auto own = static_cast<double>(cloud.position.size());
  counted = particles == own && own * ranks <= most_counted;
  return counted ? predict::share_out(cloud, ranks) : predict::share_volume(cloud, ranks, particles);
}

PredictedLine line_of(const PredictionReport& r, const predict::Cloud& cloud, const predict::Share& whole, int ranks,
                      double particles) {
  PredictedLine line;
  bool counted = false;
  const predict::Shares shares = shares_of(cloud, ranks, particles, counted);
  line.prediction = predict::predict(shares, whole, r.cost, r.memory, r.traffic, r.machine);
  line.prediction.particles = particles;  // shares by volume add up to it but for rounding
  line.prediction.counted = counted;
  line.grid = shares.grid;
  line.first = shares.ranks.front();
  return line;
}

/// The scene on one rank: its particles and pairs.
predict::Share whole_of(const predict::Cloud& cloud, double particles) {
  bool counted = false;
  return shares_of(cloud, 1, particles, counted).ranks.front();
}

/// Repeats of all lines that are measured, in turns, one rank among them: other work on the machine then comes upon all alike.
/// @param cores up to which as many runs of one rank at once take their turn too
void measure(PredictRuns& runs, const std::vector<const Prepared*>& prepared, std::vector<PredictedLine*>& lines, int repeats,
             int cores) {
  Timed one;
  std::map<int, Timed> at_once;  // by how many
  for (PredictedLine* line : lines) {
    line->measured = Timed{};
    line->measured->ranks = line->prediction.ranks;
    if (line->prediction.ranks > 1 && line->prediction.ranks <= cores) at_once[line->prediction.ranks];
  }
  for (int n = 0; n < repeats; ++n) {
    runs.time(*prepared.front(), one);
    for (std::size_t k = 0; k < lines.size() && !interrupted(); ++k) runs.time(*prepared[k + 1], *lines[k]->measured);
    for (auto& [count, timed] : at_once)
      if (!interrupted()) runs.time_at_once(*prepared.front(), count, timed);
    if (interrupted()) return;
  }
  const auto particles = static_cast<double>(prepared.front()->initial.size());
  double best = one.best_wall();
  for (const PredictedLine* line : lines)
    if (line->prediction.ranks == 1 && line->prediction.particles == particles)
      best = std::min(best, line->measured->best_wall());
  const double each = best / particles;
  for (PredictedLine* line : lines) {
    line->measured_efficiency = each * line->prediction.particles / (line->prediction.ranks * line->measured->best_wall());
    if (const auto found = at_once.find(line->prediction.ranks); found != at_once.end())
      line->speed_at_once = best / found->second.best_wall();
  }
}

/// A line of the report that is also run, and the runs for it.
struct ToMeasure {
  std::size_t line;
  const Prepared* prepared;
};

/// The line of the scene as it is on these ranks; where there is none it is added.
std::size_t line_on(PredictionReport& r, const Prepared& base, int ranks) {
  const auto particles = static_cast<double>(base.initial.size());
  const auto found = std::find_if(r.lines.begin(), r.lines.end(), [&](const auto& l) {
    return l.prediction.ranks == ranks && l.prediction.particles == particles;
  });
  if (found != r.lines.end()) return static_cast<std::size_t>(found - r.lines.begin());
  r.lines.push_back(line_of(r, base.cloud, whole_of(base.cloud, particles), ranks, particles));
  return r.lines.size() - 1;
}

/// Keys of a scene with finer particles, of which each rank has as many as one has of the scene as it is. A time step that the
/// scene fixes becomes finer too, so that particles pass as much of a spacing in a step and lists last as long.
std::vector<std::string> finer(const Scene& scene, int ranks) {
  const double by = 1.0 / std::cbrt(ranks);
  std::vector<std::string> set{fmt::format("scene.spacing={:.17g}", scene.spacing * by)};
  if (scene.time_step) set.push_back(fmt::format("scene.time_step={:.17g}", *scene.time_step * by));
  return set;
}

/// Weak scaling. @param larger keys that make the larger scene; empty: it is finer
Prepared add_weak_line(PredictionReport& r, PredictRuns& runs, const Prepared& base, int ranks,
                       const std::vector<std::string>& larger) {
  Prepared p = runs.prepare(fmt::format("weak-{}", ranks), larger.empty() ? finer(base.scene, ranks) : larger);
  p.cloud.reach = base.cloud.reach * p.scene.spacing / base.scene.spacing;
  const auto particles = static_cast<double>(p.initial.size());
  r.lines.push_back(line_of(r, p.cloud, whole_of(p.cloud, particles), ranks, particles));
  r.lines.back().weak = true;
  return p;
}

void add_lines(PredictionReport& r, PredictRuns& runs, const Options& o, const Prepared& base) {
  const auto sampled = static_cast<double>(base.initial.size());
  for (const double particles : o.particles.empty() ? std::vector<double>{sampled} : o.particles) {
    const predict::Share whole = whole_of(base.cloud, particles);
    for (const int ranks : o.ranks) r.lines.push_back(line_of(r, base.cloud, whole, ranks, particles));
  }
  std::vector<ToMeasure> measured;
  for (const int ranks : o.measure) measured.push_back({line_on(r, base, ranks), &base});
  std::vector<Prepared> weak;
  weak.reserve(o.measure.size() + o.ranks.size());  // places of its entries are kept below
  for (const int ranks : o.weak ? (o.measure.empty() ? o.ranks : o.measure) : std::vector<int>{}) {
    if (ranks == 1) continue;
    weak.push_back(add_weak_line(r, runs, base, ranks, o.larger));
    measured.push_back({r.lines.size() - 1, &weak.back()});
  }
  if (o.measure.empty()) return;
  for (Prepared& p : weak) runs.choose_end(p, base.end);
  std::vector<const Prepared*> prepared{&base};
  std::vector<PredictedLine*> lines;
  for (const ToMeasure& m : measured) {
    prepared.push_back(m.prepared);
    lines.push_back(&r.lines[m.line]);
  }
  measure(runs, prepared, lines, o.repeats, r.cores);
}

int predict_case(Options o) {
  catch_interrupts();
  const std::string file = shown_path(case_file(o.what));
  const Case value = read_case(file, o.set).value;
  PredictionReport r;
  if (!o.machine.empty()) r.machine = predict::read_machine(o.machine);
  if (o.out.empty()) o.out = own_folder("predict", value.id);
  const auto lock = hold_folder(o.out);
  const Tool tool = this_tool();
  r.case_id = value.id;
  r.version = tool.version;
  r.set = o.set;
  r.cpu = tool.cpu;
  r.cores = tool.cores;
  PredictRuns runs(file, o.set, o.out, o.seconds, o.quiet);
  const OneRankRuns one = time_one_rank(runs, o.repeats, r.notes);
  if (interrupted()) return exit_interrupted;
  for (std::size_t k = 0; k < one.prepared.size(); ++k) {
    const Prepared& p = one.prepared[k];
    const Timed& t = one.timed[k];
    r.runs.push_back({static_cast<double>(p.initial.size()), whole_of(p.cloud, static_cast<double>(p.initial.size())).worked,
                      t.best_cpu(), t.bytes});
    r.labels.push_back(p.label);
  }
  r.cost = predict::fit_work(r.runs);
  r.memory = predict::fit_memory(r.runs, one.prepared.front().weight_bytes);
  r.traffic = one.timed.front().traffic;
  if (o.machine.empty()) r.machine = runs.probe();
  if (o.machine.empty() && r.machine.latency > slow_latency)
    r.notes.push_back(
        fmt::format("the probe found {:.3g} us for a message: other programs hold the cores, so that what is said of messages is "
                    "far too slow; probe a quiet machine, or give --machine",
                    1e6 * r.machine.latency));
  add_lines(r, runs, o, one.prepared.front());
  if (interrupted()) return exit_interrupted;
  const nlohmann::ordered_json document = prediction_json(r);
  print(o.json ? document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
               : prediction_text(document));
  return exit_pass;
}

int predict_for(Options o) {
  if (!o.compare.empty()) return compare(o);
  if (o.what.empty()) throw InputError("predict: name a case, or --compare a result.json");
  if (o.ranks.empty()) o.ranks = o.measure;
  if (o.ranks.empty()) throw InputError("predict: say --ranks N[,N...]");
  if (!o.larger.empty()) o.weak = true;
  const std::vector<int>& larger_on = o.measure.empty() ? o.ranks : o.measure;
  if (!o.larger.empty() && std::count_if(larger_on.begin(), larger_on.end(), [](int n) { return n > 1; }) > 1)
    throw InputError("--weak-set makes one larger scene: name one number of ranks beside 1");
  check(o.ranks, "--ranks", most_ranks);
  check(o.measure, "--measure", most_measured);
  for (const double n : o.particles)
    if (!(n >= 1.0 && n <= 1e15)) throw InputError(fmt::format("--particles {:g}: write numbers from 1 to 1e15", n));
  if (!o.kit) return predict_case(std::move(o));
  static_cast<void>(read_case(shown_path(case_file(o.what)), o.set));  // a kit that cannot run is found out here
  if (!o.larger.empty()) throw InputError("--weak-set: a kit makes its larger scenes finer; leave one of the two out");
  check(o.ranks, "--ranks", most_measured);
  std::sort(o.ranks.begin(), o.ranks.end());
  print(predict::kit_script(o.what, o.set, o.ranks));
  return exit_pass;
}

}  // namespace

void add_predict(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("predict", description);
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->what, "a case file or id");
  command->add_option("--ranks", o->ranks, "numbers of ranks to predict, N[,N...]")->delimiter(',')->allow_extra_args(false);
  command->add_option("--particles", o->particles, "numbers of particles in the place of the case's own, by its shape: 1e7,1e9")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--machine", o->machine, "a machine file (TOML) in the place of the probe")->type_name("FILE");
  command->add_option("--measure", o->measure, "numbers of ranks to run here too, beside the prediction")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--weak", o->weak, "also P times the particles on P ranks, by a finer spacing");
  command
      ->add_option("--weak-set", o->larger,
                   "a.b=VALUE makes the scene of --weak larger, in the place of a finer spacing; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--repeats", o->repeats, "of each run, in turns; of each step the best counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seconds", o->seconds, "of each run on one rank, about")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--set", o->set, "a.b=VALUE replaces a key of the case file; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--out", o->out, "folder of the runs (default: report-predict/CASE)");
  command->add_flag("--kit", o->kit, "runs nothing: prints one shell file that measures the case on a cluster");
  command->add_option("--compare", o->compare, "runs nothing: prints this result, measured beside predicted")
      ->type_name("RESULT");
  command->add_flag("--quiet", o->quiet, "no progress on stderr");
  command->add_flag("--json", o->json, "print one JSON document");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return predict_for(*o); }); });
}

}  // namespace tripoint
