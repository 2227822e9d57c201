// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/common.hpp"
#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "scene/effect_rule.hpp"
#include "validation/harness/foreign_text.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/report_files.hpp"
#include "validation/harness/suite.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* description =
    "Puts one term of the model after the other back to its printed form, all others corrected, and prints what each correction buys:\n"
    "the metrics of each case with that one term as printed, beside those of the corrected model. OUT/ablation.json holds it; in the\n"
    "folder of a report, its page \"what each correction buys\" shows it.\n"
    "  tripoint ablate                            the cases of the commit profile that run corrected\n"
    "  tripoint ablate heat/cosine-mode solid/rotation --out report";

struct Options {
  CaseFilter filter;
  std::string out = own_folder("ablate", "");
  int jobs = 1;
};

/// Terms of two forms that act in a scene: those of the effects that it calls for, and the time scheme.
std::vector<Term> terms_of(const Scene& scene) {
  std::vector<Term> terms;
  for (const EffectRule& rule : effect_rules())
    if (calls_for(scene, rule.name)) terms.insert(terms.end(), rule.terms.begin(), rule.terms.end());
  if (!terms.empty()) terms.push_back(Term::time);
  std::sort(terms.begin(), terms.end());
  terms.erase(std::unique(terms.begin(), terms.end()), terms.end());
  return terms;
}

/// The case at its own resolution, corrected but for one term; empty: fully corrected.
Case with_printed(Case value, std::optional<Term> term) {
  value.modes = {Mode::corrected};
  value.scene.mode = Mode::corrected;
  value.scene.modes_given = {};
  if (term) value.scene.modes_given[static_cast<std::size_t>(*term)] = Mode::paper;
  value.studies.clear(), value.gates.clear(), value.inputs.clear();
  return value;
}

using Json = nlohmann::ordered_json;

Json json_of(const CaseResult& result) {
  for (const auto& engine : result.engines)
    for (const auto& run : engine.runs) {
      Json metrics = Json::object();
      for (const auto& [name, m] : run.metrics)
        metrics[name] = {{"value", std::isfinite(m.value) ? Json(m.value) : Json()}, {"uncertainty", m.uncertainty.combined()}};
      return {{"status", run.status}, {"reason", run.reason}, {"state_hash", run.state_hash}, {"cpu_s", run.cost.cpu_s}, {"metrics", metrics}};
    }
  return {{"status", "error"}, {"reason", "no run"}, {"state_hash", ""}, {"cpu_s", 0.0}, {"metrics", Json::object()}};
}

/// One round of runs: every case that has the term.
std::map<std::string, Json> round(const std::vector<Case>& cases, std::optional<Term> term, const Options& o) {
  std::vector<Case> chosen;
  for (const auto& c : cases) {
    const auto terms = terms_of(c.scene);
    if (!term || std::find(terms.begin(), terms.end(), *term) != terms.end()) chosen.push_back(with_printed(c, term));
  }
  if (chosen.empty()) return {};
  SuiteOptions options;
  options.selection.engines = {"tripoint"};
  options.out = (fs::path(o.out) / "ablation" / (term ? std::string(to_string(*term)) : "corrected")).string();
  options.jobs = o.jobs, options.say = [](const std::string& line) { say(line); };
  options.wanted = [](const EnginePlan&, const RunPlan& run) { return run.base; };
  std::map<std::string, Json> found;
  for (const auto& c : run_suite(chosen, discover_engines({}), options).cases) found[c.id] = json_of(c);
  return found;
}

std::string number_text(const Json& run, const std::string& metric) {
  const auto& v = run["metrics"].contains(metric) ? run["metrics"][metric]["value"] : Json();
  return v.is_number() ? fmt::format("{:.4g}", v.get<double>()) : run["status"].get<std::string>();
}

int ablate(const Options& o) {
  catch_interrupts();
  std::vector<Case> cases;
  for (auto& c : select_cases(o.filter)) {
    const bool corrected = std::find(c.modes.begin(), c.modes.end(), Mode::corrected) != c.modes.end();
    if (corrected && c.expect != "diverges" && !terms_of(c.scene).empty()) cases.push_back(std::move(c));
  }
  if (cases.empty()) throw InputError("ablate: no case runs corrected");
  make_folder(o.out);
  const auto base = round(cases, {}, o);
  std::map<std::string, Json> terms;
  for (std::size_t t = 0; t < term_count && !interrupted(); ++t)
    for (auto& [id, run] : round(cases, static_cast<Term>(t), o)) {
      const bool acts = base.count(id) && run["state_hash"] != base.at(id)["state_hash"];
      if (acts) terms[id][std::string(to_string(static_cast<Term>(t)))] = run;
    }
  Json document = Json::array();
  for (const auto& c : cases) {
    if (!base.count(c.id)) continue;
    Json metrics = Json::array();
    for (const auto& m : c.metrics) metrics.push_back({{"name", m.name}, {"unit", m.unit}, {"quantity", m.quantity}});
    document.push_back({{"id", c.id}, {"title", c.title}, {"metrics", metrics}, {"corrected", base.at(c.id)}, {"printed", terms.count(c.id) ? terms[c.id] : Json::object()}});
    print_line(c.id);
    for (const auto& m : c.metrics) {
      print(fmt::format("  {:24} corrected {:>12}", one_line(m.name), number_text(base.at(c.id), m.name)));
      if (terms.count(c.id))
        for (const auto& [term, run] : terms[c.id].items()) print(fmt::format("  {} {:>10}", term, number_text(run, m.name)));
      print("\n");
    }
  }
  write_durably((fs::path(o.out) / "ablation.json").string(), Json{{"format", 1}, {"tool", this_tool().commit}, {"cases", document}}.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  const auto results = fs::path(o.out) / "results.json";
  const auto next = fs::exists(results) ? "tripoint report " + results.string() + " draws its page" : "with --out the folder of a report, tripoint report draws its page";
  print(fmt::format("{}; {}\n", (fs::path(o.out) / "ablation.json").string(), next));
  return interrupted() ? exit_interrupted : exit_pass;
}

}  // namespace

void add_ablate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("ablate", description);
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->filter.what, "case files, folders of them, or ids")->type_name("CASE|DIR");
  command->add_option("--profile", o->filter.profile, "only cases of this profile (commit where no CASE is given)")->check(CLI::IsMember({"commit", "nightly", "release"}));
  command->add_option("--tag", o->filter.tag, "only cases with this tag");
  command->add_option("--out", o->out, "folder of ablation.json and the runs")->capture_default_str();
  command->add_option("--jobs", o->jobs, "engine processes at a time")->check(CLI::Range(1, 1024))->capture_default_str();
  command->callback([o, &exit_code] {
    if (o->filter.what.empty() && o->filter.profile.empty() && o->filter.tag.empty()) o->filter.profile = "commit";
    exit_code = guarded([&] { return ablate(*o); });
  });
}

}  // namespace tripoint
