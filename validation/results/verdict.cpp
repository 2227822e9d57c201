// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/verdict.hpp"

namespace tripoint {

int first_of(const std::set<int>& codes) {
  if (codes.count(exit_interrupted)) return exit_interrupted;
  for (const int code :
       {exit_selftest, exit_bad_input, exit_diverged, exit_missing, exit_fail, exit_inconclusive, exit_cost})
    if (codes.count(code)) return code;
  return exit_pass;
}

CaseVerdict verdict_of(int exit_code) {
  return exit_code >= exit_pass && exit_code <= exit_diverged ? static_cast<CaseVerdict>(exit_code)
                                                              : CaseVerdict::interrupted;
}

std::string verdict_word(int exit_code) { return std::string(to_string(verdict_of(exit_code))); }

}  // namespace tripoint
