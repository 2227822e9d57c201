// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.hpp"
#include "cli/common.hpp"
#include "core/errors.hpp"
#include "validation/harness/judge.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/report_files.hpp"
#include "validation/harness/selftest.hpp"

namespace tripoint {
namespace {

constexpr const char* description =
    "Judges a results.json from its measured values and limits alone; it runs nothing and trusts no stored verdict.\n"
    "  tripoint gate report/results.json     exit 0 only when every gate is green\n"
    "  tripoint gate selftest                proves that the gates can fail, and only where they should";

constexpr const char* selftest_description =
    "Runs every defect that the cases declare in the test build of our solver, and expects the gates named in killed_by to turn red;\n"
    "and asks that every defect which a physical term registers has a case that kills it. Then runs every harmless change that the cases\n"
    "declare (threads, order, ulp, boost, mirror, rotation, units): no gate may turn and no metric may change by more than round-off.\n"
    "Exit 5 when a defect survives or a harmless change is felt.\n"
    "  tripoint gate selftest                every case\n"
    "  tripoint gate selftest heat/cosine-mode --jobs 2";

struct GateOptions {
  std::string results;
  SelftestOptions selftest;
};

int judge_file(const std::string& path) {
  auto results = read_results(path);
  judge(results);
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  for (const auto& p : results.problems) print(p + "\n");
  print("verdict " + results.verdict + " exit " + std::to_string(results.exit_code) + "\n");
  return results.exit_code;
}

int selftest(SelftestOptions options) {
  catch_interrupts();
  options.say = [](const std::string& line) { say(line); };
  const auto outcome = run_selftest(options);
  print(selftest_table(outcome));
  return outcome.exit_code;
}

}  // namespace

void add_gate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("gate", description);
  auto o = std::make_shared<GateOptions>();
  command->add_option("RESULTS", o->results, "a results.json");
  auto* self = command->add_subcommand("selftest", selftest_description);
  self->add_option("CASE", o->selftest.what, "case files, folders or ids; none = every case")->type_name("CASE|DIR");
  self->add_option("--out", o->selftest.out, "folder of the runs")->capture_default_str();
  self->add_option("--jobs", o->selftest.jobs, "engine processes at a time")->check(CLI::Range(1, 1024))->capture_default_str();
  command->callback([=, &exit_code] {
    exit_code = guarded([&] {
      if (self->parsed()) return selftest(o->selftest);
      if (o->results.empty()) throw InputError("gate: name a results.json, or selftest");
      return judge_file(o->results);
    });
  });
}

}  // namespace tripoint
