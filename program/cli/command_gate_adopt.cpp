// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/common.hpp"
#include "program/cli/gate_adopt.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/harness/adopt.hpp"
#include "validation/harness/apply_gate.hpp"
#include "validation/harness/baseline.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/report_files.hpp"
#include "validation/harness/sandbox.hpp"
#include "validation/harness/suite.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* adopt_description =
    "Measures an engine of your own on the acceptance cases, twice and with other seeds where chance has a hand, and writes a "
    "case file with\n"
    "gates into your repository for each case that it runs: what drifts from then on, to the worse or to the better, is red. "
    "Baselines are\n"
    "accepted beside them. Cases that the engine refuses are left out.\n"
    "  tripoint gate adopt --engine ./my-engine --out cases\n"
    "  tripoint gate adopt --engine my-engine --margin 1.2 --out cases rigid/ballistic\n"
    "Exit 0 when the written gates hold on a run of their own, 2 when a file is there already, 4 when the engine runs none of "
    "the cases.";

struct GateAdoptOptions {
  std::string engine, out = "cases";
  std::vector<std::string> what;
  AdoptOptions adopt;
  bool overwrite = false, sandbox = false;
};

std::string today() {
  const std::time_t t = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&t));
  return text;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The case's own text; where it has a short form, the whole case below its first comment. An adopted case stands on its own, and
/// its gates are tables that can be dropped one by one.
std::string source_text(const std::string& file) {
  const std::string text = text_of(file);
  if (!has_short_forms(read_toml(file))) return text;
  std::istringstream in(text);
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with("#");) comment += line + "\n";
  return comment + resolved_case(read_case(file));
}

fs::path file_of(const GateAdoptOptions& o, const std::string& id) { return fs::path(o.out) / (id + ".toml"); }

std::vector<Case> cases_of(const GateAdoptOptions& o) {
  CaseFilter filter;
  filter.what = o.what;
  if (o.what.empty()) filter.profile = "acceptance";
  auto cases = select_cases(filter);
  for (const auto& c : cases)
    if (!o.overwrite && fs::exists(file_of(o, c.id)))
      throw InputError(fmt::format(
          "{}: is there already; --overwrite writes it anew, and `tripoint gate accept` keeps new figures of old gates",
          file_of(o, c.id).string()));
  return cases;
}

EngineEntry engine_of(const GateAdoptOptions& o, std::vector<EngineEntry>& engines) {
  if (o.sandbox) sandbox_strangers(o.adopt.work);
  const auto words = sort_engine_words({o.engine});
  engines = discover_engines(words.paths);
  const std::string name = words.paths.empty() ? o.engine : ask_engine(words.paths.front()).name;
  const auto* found = find_engine(engines, name);
  if (!found) throw EngineError(no_such_engine(name, engines));
  if (!found->available) throw EngineError(fmt::format("{}: {}", found->name, found->reason));
  return *found;
}

/// Writes the case files of the measured values. @return their paths
std::vector<std::string> write_cases(const GateAdoptOptions& o, const std::vector<AdoptedCase>& measured,
                                     const EngineEntry& engine) {
  std::vector<std::string> files;
  for (const auto& c : measured) {
    if (!c.judged()) continue;
    const auto file = file_of(o, c.id);
    const auto text = adopted_text(source_text(c.source), c, engine);
    fs::create_directories(file.parent_path());
    write_durably(file.string(), text);
    files.push_back(file.string());
    print(fmt::format("wrote {}\n", file.string()));
    for (const auto& row : c.rows)
      for (const auto& g : row.gates)
        print(fmt::format("  {:28} {:34} {}\n", g.metric + (is_default_preset(row.preset) ? "" : " (" + row.preset + ")"),
                          describe(g), g.reason));
  }
  return files;
}

/// The written gates judge a run of their own before anything is accepted.
int accept_written(const GateAdoptOptions& o, const std::vector<std::string>& files, const std::vector<EngineEntry>& engines,
                   const EngineEntry& engine) {
  CaseFilter filter;
  filter.what = files;
  SuiteOptions suite;
  suite.selection.engines = suite.selection.asked = {engine.name};
  suite.jobs = o.adopt.jobs;
  suite.out = (fs::path(o.adopt.work) / "written").string();
  auto results = run_suite(select_cases(filter), engines, suite);
  results.date = today();
  results.what = files;
  results.command = command_line();
  write_results(results, suite.out);
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  if (results.exit_code != exit_pass) {
    say("tripoint: the gates that were just written do not hold on a second look, and no baseline was accepted: is the engine "
        "deterministic?");
    return results.exit_code;
  }
  fs::create_directories(baseline_folder(files.front()));
  print(accept(
      results, {},
      {results.date, results.tool.commit,
       fmt::format("adopted from {} {} by tripoint gate adopt --margin {:g}", engine.name, engine.version, o.adopt.margin)}));
  return exit_pass;
}

int adopt(GateAdoptOptions o) {
  catch_interrupts();
  std::vector<EngineEntry> engines;
  const auto engine = engine_of(o, engines);
  const auto cases = cases_of(o);
  o.adopt.date = today();
  const auto measured = measure_to_adopt(cases, engine, o.adopt, say);
  const auto files = write_cases(o, measured, engine);
  if (files.empty())
    throw EngineError(fmt::format("{} ran none of {} cases: there is nothing to gate", engine.name, cases.size()));
  const int code = accept_written(o, files, engines, engine);
  say(
      fmt::format("{} of {} cases adopted. Commit {} and {}. From then on:\n  tripoint validate {} --engine {} --engines {}\n  "
                  "tripoint gate report",
                  files.size(), cases.size(), o.out, baseline_folder(files.front()), o.out, o.engine, engine.name));
  return code;
}

}  // namespace

CLI::App* add_gate_adopt(CLI::App& gate, int& exit_code) {
  auto* command = gate.add_subcommand("adopt", adopt_description);
  auto o = std::make_shared<GateAdoptOptions>();
  command->add_option("CASE", o->what, "case files, folders or ids; none = the profile acceptance")->type_name("CASE|DIR");
  command->add_option("--engine", o->engine, "the engine: the path of an executable, or a name")->required();
  add_sandbox_flag(*command, o->sandbox);
  command->add_option("--margin", o->adopt.margin, "factor by which an error may grow or shrink before that is red")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  command->add_option("--out", o->out, "folder of the written cases; baselines go beside it")->capture_default_str();
  command->add_option("--seeds", o->adopt.seeds, "other seeds, where chance has a hand in a run")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--jobs", o->adopt.jobs, "engine processes at a time")->check(CLI::Range(1, 1024))->capture_default_str();
  command->add_option("--work", o->adopt.work, "folder of the runs")->capture_default_str();
  command->add_flag("--overwrite", o->overwrite, "write files that are there anew");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return adopt(*o); }); });
  return command;
}

}  // namespace tripoint
