// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <set>
#include <string>

#include "tables/words.hpp"

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

/// The first of 5 2 7 4 1 3 6 that is among the codes; 0 where there is none.
[[nodiscard]] int first_of(const std::set<int>& codes);

/// Verdict on a case, or on a whole: a word for each exit code. PASS goes with 0; refused goes with 0 too,
/// where no engine that was asked takes the case.
enum class CaseVerdict {
  pass,
  fail,
  bad_input,
  inconclusive,
  missing,
  selftest,
  cost,
  diverged,
  interrupted,
  refused
};
constexpr WordTable<10> word_table(CaseVerdict) {
  return {"verdict of a case",
          {"PASS", "FAIL", "BAD INPUT", "INCONCLUSIVE", "MISSING", "SELF-TEST FAILED", "COST REGRESSION",
           "DIVERGED", "INTERRUPTED", "REFUSED"}};
}
[[nodiscard]] CaseVerdict verdict_of(int exit_code);
/// Its word.
[[nodiscard]] std::string verdict_word(int exit_code);

}  // namespace tripoint
