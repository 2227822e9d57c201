// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/one_case.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"
#include "program/cli/common.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {

Case one_case(const std::string& what) {
  CaseFilter filter;
  filter.what = {what};
  auto cases = select_cases(filter);
  if (cases.size() != 1) throw InputError(what + ": names more than one case");
  return cases.front();
}

Results run_one_case(const Case& value, const SuiteOptions& options, const std::vector<std::string>& paths) {
  catch_interrupts();
  const auto engines = discover_engines(paths);
  for (const auto& name : options.selection.engines)
    if (!find_engine(engines, name)) throw EngineError(no_such_engine(name, engines));
  const auto lock = hold_folder(options.out);
  auto results = run_suite({value}, engines, options);
  results.command = command_line();
  if (const auto missing = write_report(results, options.out); !missing.empty())
    say("tripoint: no page: " + missing);
  return results;
}

/// Exit code for the fault that kept the runs from being compared; accuracy is not judged here.
int code_of_runs(const CaseResult& result) {
  if (interrupted()) return exit_interrupted;
  int code = exit_pass;
  for (const auto& e : result.engines) {
    if (e.status == Status::diverged) return exit_diverged;
    if (e.status != Status::ok) {
      say(fmt::format("{} {}: {}", e.name, e.status, e.reason));
      code = exit_missing;
    }
  }
  return code;
}

}  // namespace tripoint
