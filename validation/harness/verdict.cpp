// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/verdict.hpp"

namespace tripoint {

int first_of(const std::set<int>& codes) {
  if (codes.count(exit_interrupted)) return exit_interrupted;
  for (const int code : {exit_selftest, exit_bad_input, exit_diverged, exit_missing, exit_fail, exit_inconclusive, exit_cost})
    if (codes.count(code)) return code;
  return exit_pass;
}

std::string verdict_word(int exit_code) {
  switch (exit_code) {
    case exit_pass:
      return "PASS";
    case exit_fail:
      return "FAIL";
    case exit_bad_input:
      return "BAD INPUT";
    case exit_inconclusive:
      return "INCONCLUSIVE";
    case exit_missing:
      return "MISSING";
    case exit_selftest:
      return "SELF-TEST FAILED";
    case exit_cost:
      return "COST REGRESSION";
    case exit_diverged:
      return "DIVERGED";
    default:
      return "INTERRUPTED";
  }
}

}  // namespace tripoint
