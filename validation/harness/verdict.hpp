// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <set>
#include <string>

/// Exit codes of the contract and the words that go with them.
namespace tripoint {

enum ExitCode : int {
  exit_pass = 0,
  exit_fail = 1,
  exit_bad_input = 2,
  exit_inconclusive = 3,
  exit_missing = 4,
  exit_selftest = 5,
  exit_cost = 6,
  exit_diverged = 7,
  exit_interrupted = 130
};

/// Of several at once the first of 5 2 7 4 1 3 6; of none, 0.
[[nodiscard]] int first_of(const std::set<int>& codes);

/// PASS FAIL INCONCLUSIVE MISSING DIVERGED ...: PASS goes with 0 and nothing else.
[[nodiscard]] std::string verdict_word(int exit_code);

}  // namespace tripoint
