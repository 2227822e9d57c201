// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// Judging results that are there: `tripoint gate RESULTS`, `tripoint gate propose` and `tripoint summary`. None runs anything or
/// writes a baseline.
namespace tripoint {

struct JudgeOptions {
  std::string results, history, baselines;
  std::string against, again;  ///< results of a base, and of the base once more (A/A); empty = none
  bool annotations = false, require_baselines = false, no_worse = false, informational = false;
};

void add_judge_options(CLI::App& gate, JudgeOptions&);
/// Prints the verdict, what is said of the results and, with a base, every metric beside it. @return the exit code
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
