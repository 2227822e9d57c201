// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/ablation.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/json_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* ablate_description =
    "Shows the effect of each correction. Each term in turn gets its printed form, and the metrics of\n"
    "each case are printed beside those of the corrected model. A term that the paper does not have is\n"
    "left out instead, and its row has its name in [model] (bulk_viscosity). OUT/ablation.json holds the\n"
    "table. In the folder of a report, its page \"what each correction buys\" shows it.\n"
    "  tripoint ablate                            the cases of the commit profile that run corrected\n"
    "  tripoint ablate heat/cosine-mode solid/rotation --out report";

struct AblateOptions {
  CaseFilter filter;
  std::string out = own_folder("ablate", "");
  int jobs = 1;
};

using Json = nlohmann::ordered_json;

Json json_of(const CaseResult& result) {
  for (const auto& engine : result.engines)
    for (const auto& run : engine.runs) {
      Json metrics = Json::object();
      for (const auto& [name, m] : run.metrics)
        metrics[name] = {{"value", std::isfinite(m.value) ? Json(m.value) : Json()},
                         {"uncertainty", m.uncertainty.combined()}};
      return {{"status", run.status},
              {"reason", run.reason},
              {"state_hash", run.state_hash},
              {"cpu_s", run.cost.cpu_s},
              {"metrics", metrics}};
    }
  return {{"status", "error"},
          {"reason", "no run"},
          {"state_hash", ""},
          {"cpu_s", 0.0},
          {"metrics", Json::object()}};
}

/// One round of runs, in a folder of its own.
std::map<std::string, Json> round(const std::vector<Case>& chosen, const std::string& name,
                                  const AblateOptions& o) {
  if (chosen.empty()) return {};
  SuiteOptions options;
  options.selection.engines = {engine_name::solver};
  options.out = (fs::path(o.out) / "ablation" / name).string();
  options.jobs = o.jobs;
  options.say = [](const std::string& line) { say(line); };
  options.wanted = [](const EnginePlan&, const RunPlan& run) { return run.base; };
  std::map<std::string, Json> found;
  for (const auto& c : run_suite(chosen, discover_engines({}), options).cases) found[c.id] = json_of(c);
  return found;
}

std::string number_text(const Json& run, const std::string& metric) {
  const auto& v = run["metrics"].contains(metric) ? run["metrics"][metric]["value"] : Json();
  return v.is_number() ? fmt::format("{:.4g}", v.get<double>()) : run["status"].get<std::string>();
}

/// The scene as it runs: with what it takes by rule, as a stiffness where its bodies can meet.
Scene as_it_runs(const Case& c) { return scene_for(c, {Mode::corrected, {}, {}, {}, {}, {}}); }

/// Cases that run corrected, and in which something can be put back.
std::vector<Case> cases_of(const AblateOptions& o) {
  std::vector<Case> cases;
  for (auto& c : select_cases(o.filter)) {
    const bool runs_so = std::find(c.modes.begin(), c.modes.end(), Mode::corrected) != c.modes.end();
    if (runs_so && c.expect != Expect::diverges && !acting_terms(as_it_runs(c)).empty())
      cases.push_back(corrected(std::move(c)));
  }
  if (cases.empty()) throw InputError("ablate: no case runs corrected");
  return cases;
}

/// By case: its run without each piece, where that has other bits than the corrected run.
std::map<std::string, Json> runs_without_pieces(const std::vector<Case>& cases,
                                                const std::map<std::string, Json>& base,
                                                const AblateOptions& o) {
  std::map<std::string, Json> found;
  for (const Correction& piece : corrections()) {
    if (interrupted()) break;
    std::vector<Case> chosen;
    for (const auto& c : cases)
      if (can_act(piece, as_it_runs(c))) chosen.push_back(without(piece, c));
    for (auto& [id, run] : round(chosen, piece.name, o)) {
      const bool acts = base.count(id) && run["state_hash"] != base.at(id)["state_hash"];
      if (acts) found[id][piece.name] = run;
    }
  }
  return found;
}

Json json_of(const Case& c, const Json& whole, const Json& without_pieces) {
  Json metrics = Json::array();
  for (const auto& m : c.metrics)
    metrics.push_back({{"name", m.name}, {"unit", m.unit}, {"quantity", m.quantity}});
  return {{"id", c.id},
          {"title", c.title},
          {"metrics", metrics},
          {"corrected", whole},
          {"printed", without_pieces}};
}

void print_case(const Case& c, const Json& whole, const Json& without_pieces) {
  print_line(c.id);
  for (const auto& m : c.metrics) {
    print(fmt::format("  {:24} corrected {:>12}", one_line(m.name), number_text(whole, m.name)));
    for (const auto& [piece, run] : without_pieces.items())
      print(fmt::format("  {} {:>10}", piece, number_text(run, m.name)));
    print("\n");
  }
}

int ablate(const AblateOptions& o) {
  catch_interrupts();
  const std::vector<Case> cases = cases_of(o);
  const auto lock = hold_folder(o.out);
  const auto base = round(cases, "corrected", o);
  const auto printed = runs_without_pieces(cases, base, o);
  Json document = Json::array();
  for (const auto& c : cases) {
    if (!base.count(c.id)) continue;
    const Json none = Json::object();
    const Json& without_pieces = printed.count(c.id) ? printed.at(c.id) : none;
    document.push_back(json_of(c, base.at(c.id), without_pieces));
    print_case(c, base.at(c.id), without_pieces);
  }
  write_durably((fs::path(o.out) / "ablation.json").string(),
                json_text(Json{{"format", 1}, {"tool", this_tool().commit}, {"cases", document}}));
  const auto results = fs::path(o.out) / "results.json";
  const auto next = fs::exists(results) ? "tripoint report " + results.string() + " draws its page"
                                        : "with --out the folder of a report, tripoint report draws its page";
  print(fmt::format("{}; {}\n", (fs::path(o.out) / "ablation.json").string(), next));
  return interrupted() ? exit_interrupted : exit_pass;
}

}  // namespace

void add_ablate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("ablate", ablate_description);
  auto o = std::make_shared<AblateOptions>();
  command->add_option("CASE", o->filter.what, "case files, folders of them, or ids")->type_name("CASE|DIR");
  command
      ->add_option("--profile", o->filter.profile,
                   "only cases of this profile (commit where no CASE is given)")
      ->check(CLI::IsMember({"commit", "nightly", "release"}));
  command->add_option("--tag", o->filter.tag, "only cases with this tag");
  command->add_option("--out", o->out, "folder of ablation.json and the runs")->capture_default_str();
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o, &exit_code] {
    if (o->filter.what.empty() && o->filter.profile.empty() && o->filter.tag.empty())
      o->filter.profile = "commit";
    exit_code = guarded([&] { return ablate(*o); });
  });
}

}  // namespace tripoint
