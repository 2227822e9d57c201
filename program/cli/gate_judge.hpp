// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/results/results.hpp"

namespace CLI {
class App;
}

/// Judging results that are there: `tripoint gate RESULTS`, `tripoint gate propose` and `tripoint summary`.
/// These commands neither run anything nor write a baseline.
namespace tripoint {

struct JudgeOptions {
  std::string results, history, baselines;
  std::string against, again;  ///< results of a base, and of the base once more (A/A); empty = none
  bool annotations = false, require_baselines = false, no_worse = false, informational = false;
};

/// The results of a results.json, or of the folder of a report, judged anew. @throws InputError where there
/// are none
[[nodiscard]] Results judged_results(const std::string& path);

/// Results name a case by its path from the folder in which `validate` was called. From another folder no
/// case can be read again, and the verdict alone would not tell why. This function says on stderr in which
/// folder to call.
void say_if_called_elsewhere(const Results&, const std::string& path);

void add_judge_options(CLI::App& gate, JudgeOptions&);
/// Prints the verdict, the remarks about the results and, with a base, every metric beside it. @return the
/// exit code
[[nodiscard]] int judge_results(const JudgeOptions&);

struct ProposeOptions {
  std::vector<std::string> words;  ///< a results.json and ids, in any order
  std::string reason, patch;
};

/// @return the subcommand, to ask whether it was called
[[nodiscard]] CLI::App* add_propose(CLI::App& gate, ProposeOptions&);
[[nodiscard]] int propose_baselines(const ProposeOptions&);

/// Adds the command `summary` to the program, and sets the exit code when it was called.
void add_summary(CLI::App& app, int& exit_code);

}  // namespace tripoint
