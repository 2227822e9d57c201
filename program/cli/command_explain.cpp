// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "assembly/plan.hpp"
#include "program/bench/trial.hpp"
#include "program/cli/case_summary.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "scene/model.hpp"
#include "validation/campaign/case_names.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"
#include "validation/case/shape_match.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;

constexpr long usual_trial = 3;              ///< steps
constexpr std::size_t most_tried = 100'000;  ///< particles, unless --trial asks for more

constexpr const char* explain_description =
    "Says what a case means: a summary, then every key with its value in SI and the reason for it. Then\n"
    "come the effects that the scene calls for, and those that it does without, with reasons. The last\n"
    "lines are the bytes of its particles by effect and the seconds of its first steps.\n"
    "  tripoint explain rigid/ballistic\n"
    "  tripoint explain fluid/hydrostatic --trial 20 --threads 2\n"
    "  tripoint explain my.toml --set scene.spacing=\"2 mm\" --json | jq .effects\n"
    "  tripoint explain contact/tower-100 --resolved      the whole of a case that extends another";

std::string origin(const Decision& d, const std::string& file) {
  if (!d.given) return "default: " + d.reason;
  if (d.place.line <= 0) return "given, " + d.place.file;
  return d.place.file == file ? fmt::format("given, line {}", d.place.line)
                              : fmt::format("given, {}:{}", d.place.file, d.place.line);
}

/// Whether an effect of the scene has the form, or a form that stands for it.
bool is_read(const Scene& scene, const ModelTerm& t) {
  return std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
    return (&rule == t.rule || (t.term && reads_term(rule, *t.term))) && calls_for(scene, rule.name);
  });
}

/// Why the form of a term changes nothing in this scene; "" = it acts, or leaves the term out.
std::string why_idle(const Scene& scene, const ModelTerm& t) {
  const ModelForm* form = form_in(scene, t);
  if (!t.rule || !form || form == &t.forms.back()) return "";
  if (is_read(scene, t)) return why_idle(scene, t, *form);
  return t.rule->left_out ? t.rule->left_out(scene) : "";
}

/// Why a form of a term or the number of an effect's key changes nothing in this scene; "" = it acts, is not
/// set, or no effect brings it.
std::string why_idle(const Scene& scene, const Decision& d) {
  for (const ModelTerm& t : model_terms())
    if (d.key == fmt::format("model.{}", t.name)) return why_idle(scene, t);
  for (const EffectRule& rule : effect_rules())
    for (const EffectKey& key : rule.keys) {
      if (key.row.table != "scene" || d.key != fmt::format("scene.{}", key.row.name)) continue;
      if (d.value == "0" || d.value == "false") return "";
      const std::string why = key.idle ? key.idle(scene) : "";
      return why.empty() && rule.left_out && !calls_for(scene, rule.name) ? rule.left_out(scene) : why;
    }
  return "";
}

/// Keys that are not set are only counted: they would hide the others.
void print_decisions(const Scene& scene, const std::vector<Decision>& decisions, const std::string& file) {
  std::size_t width = 0, unset = 0;
  for (const auto& d : decisions) width = std::max(width, std::min<std::size_t>(d.key.size(), 44));
  for (const auto& d : decisions) {
    if (d.value == "none" && !d.given) {
      ++unset;
      continue;
    }
    const std::string idle = why_idle(scene, d);
    print_line(fmt::format("{:{}}  {:24}  # {}{}", d.key, width, d.value, origin(d, file),
                           idle.empty() ? "" : "; changes nothing here: " + idle));
  }
  print(fmt::format("\n{} keys are not set (with --json: each with what that means).\n", unset));
}

/// Bytes a particle of each effect, the greatest first.
std::vector<std::pair<std::string, std::size_t>> bytes_by_owner(const Plan& plan) {
  std::map<std::string, std::size_t> sums;
  for (const auto& f : plan.fields)
    if (f.per == "particle") sums[f.owner] += f.bytes;
  std::vector<std::pair<std::string, std::size_t>> list(sums.begin(), sums.end());
  std::ranges::stable_sort(list, std::greater{}, &std::pair<std::string, std::size_t>::second);
  return list;
}

void print_plan(const Plan& plan) {
  print("\nEffects\n");
  for (const auto& e : plan.effects) print_line(fmt::format("  {:10} {:10} {}", e.name, e.mode, e.why));
  print("\nDoes without\n");
  for (const auto& e : plan.idle) print_line(fmt::format("  {:10} {}", e.name, e.why));
  print("\nFields\n");
  for (const auto& f : plan.fields)
    print_line(fmt::format("  {:24} {:8} {:8} of {:10} {} bytes", f.name, f.unit, f.per, f.owner, f.bytes));
  print(fmt::format("\n{} bytes a particle\n", plan.bytes_per_particle));
  for (const auto& [owner, bytes] : bytes_by_owner(plan)) print_line(fmt::format("  {:10} {}", owner, bytes));
}

void print_trial(const bench::Trial& t, int threads) {
  if (!t.failure.empty())
    return print(fmt::format("\nNo steps are timed (--trial N times N): {}\n", t.failure));
  if (t.steps == 0) return;
  print(fmt::format("\nMeasured in the first {} steps of {} particles on {} thread{}\n", t.steps, t.particles,
                    threads, threads == 1 ? "" : "s"));
  print(
      fmt::format("  {:.3g} s a step, {:.3g} us a particle-step; about {:.0f} steps of {:.3g} s, bound by "
                  "{}, so about {:.3g} s "
                  "for the whole run, and {:.3g} s to set it up\n",
                  t.step_seconds, 1e6 * t.step_seconds / static_cast<double>(t.particles), t.run_steps,
                  t.time_step, t.bound_by, t.run_seconds(), t.setup_seconds));
  if (t.particles >= most_tried / 10)  // else the program itself outweighs them
    print(fmt::format(
        "  {:.0f} bytes a particle in memory: fields, neighbour lists, bonds and what is used between them\n",
        t.bytes));
  for (std::size_t k = 0; k < stage_names.size(); ++k)
    if (t.stages[k] > 0.005 * t.step_seconds)
      print(fmt::format("  {:10} {:4.1f} %\n", stage_names[k], 100.0 * t.stages[k] / t.step_seconds));
}

json as_json(const bench::Trial& t, int threads) {
  if (!t.failure.empty()) return {{"failure", t.failure}};
  json stages = json::object();
  for (std::size_t k = 0; k < stage_names.size(); ++k) stages[std::string(stage_names[k])] = t.stages[k];
  return {{"steps", t.steps},
          {"particles", t.particles},
          {"threads", threads},
          {"setup_seconds", t.setup_seconds},
          {"step_seconds", t.step_seconds},
          {"stages", stages},
          {"time_step", t.time_step},
          {"run_steps", t.run_steps},
          {"run_seconds", t.run_seconds()},
          {"bytes_per_particle", t.bytes}};
}

json as_json(const CaseReading& reading, const Scene& scene, const Plan& plan) {
  json decisions = json::array(), effects = json::array(), fields = json::array(), idle = json::array(),
       bytes = json::object();
  for (const auto& d : reading.decisions) {
    json row{{"key", d.key}, {"value", d.value}, {"given", d.given}, {"reason", d.reason}};
    if (d.given && !d.place.file.empty()) row["file"] = d.place.file;
    if (d.given && d.place.line > 0) row["line"] = d.place.line;
    if (const std::string why = why_idle(scene, d); !why.empty()) row["changes_nothing"] = why;
    decisions.push_back(std::move(row));
  }
  for (const auto& e : plan.effects) effects.push_back({{"name", e.name}, {"mode", e.mode}, {"why", e.why}});
  for (const auto& f : plan.fields)
    fields.push_back(
        {{"name", f.name}, {"unit", f.unit}, {"per", f.per}, {"owner", f.owner}, {"bytes", f.bytes}});
  for (const auto& e : plan.idle) idle.push_back({{"name", e.name}, {"why", e.why}});
  for (const auto& [owner, sum] : bytes_by_owner(plan)) bytes[owner] = sum;
  return {{"format", 1},
          {"case", reading.value.id},
          {"file", reading.value.file},
          {"decisions", decisions},
          {"effects", effects},
          {"does_without", idle},
          {"fields", fields},
          {"bytes_per_particle", plan.bytes_per_particle},
          {"bytes_by_effect", bytes}};
}

bool has_mesh(const Shape& s) { return s.kind == Shape::Kind::mesh || std::ranges::any_of(s.of, has_mesh); }
bool has_mesh(const Scene& s) {
  return std::ranges::any_of(s.bodies, [](const Body& b) { return has_mesh(b.shape); });
}

json meshes_of(const Scene& s) {
  json list = json::array();
  for (const auto& m : mesh_bodies(s, sample(s)))
    list.push_back({{"body", s.bodies[m.body].name},
                    {"triangles", m.triangles},
                    {"extent", {m.extent.x, m.extent.y, m.extent.z}},
                    {"mass", m.shape.mass},
                    {"mass_of_particles", m.particles}});
  return list;
}

struct ExplainOptions {
  std::string file;
  std::vector<std::string> set;
  bool as_document = false, as_case = false;
  std::optional<long> trial;  ///< steps; empty: a few for people, none for programs
  int threads = 1;
};

int explain(const ExplainOptions& options) {
  const CaseReading reading = read_case(shown_path(case_file(options.file)), options.set);
  if (options.as_case) {
    print(resolved_case(reading, options.set));
    return 0;
  }
  for (const auto& f : old_keys(reading)) say("note: " + with_place(f));
  const Plan planned = plan_of(reading);
  const Scene scene = scene_for(reading.value, {});
  const auto trial = [&](long steps) {
    return bench::try_scene(scene, steps, options.threads, options.trial ? SIZE_MAX : most_tried);
  };
  if (options.as_document) {
    json document = as_json(reading, scene, planned);
    if (has_mesh(scene)) document["meshes"] = meshes_of(scene);
    if (options.trial.value_or(0) > 0) document["trial"] = as_json(trial(*options.trial), options.threads);
    print(json_text(document, 2));
    return 0;
  }
  const long steps = options.trial.value_or(usual_trial);
  const auto timed = steps > 0 ? trial(steps) : bench::Trial{};
  print(case_summary(reading.value, scene, planned, timed));
  if (has_mesh(scene))
    for (const auto& f : mesh_notes(scene, sample(scene))) print_line(f.what);
  print_decisions(scene, reading.decisions, reading.value.file);
  print_plan(planned);
  if (steps > 0) print_trial(timed, options.threads);
  return 0;
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("explain", explain_description);
  auto options = std::make_shared<ExplainOptions>();
  command->add_option("CASE", options->file, "path of a case file, or the id of a case that is shipped")
      ->required();
  command
      ->add_option("--set", options->set,
                   "replace a key: scene.spacing=0.01, body.NAME.velocity=[1,0,0]; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--json", options->as_document, "print one JSON document");
  command->add_flag(
      "--resolved", options->as_case,
      "print the whole case as a case file: what it extends merged in, every gate in a table of its own");
  command
      ->add_option("--trial", options->trial,
                   fmt::format("steps to time, 0 for none (default: {}; none with --json)", usual_trial))
      ->check(CLI::NonNegativeNumber);
  command->add_option("--threads", options->threads, "threads of the steps that are timed")
      ->check(CLI::PositiveNumber);
  command->callback([=, &exit_code] { exit_code = guarded([&] { return explain(*options); }); });
}

}  // namespace tripoint
