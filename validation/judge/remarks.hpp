// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "validation/results/results.hpp"

/// Remarks of a gate about results, one sentence each, with the line of the case file that it is about.
namespace tripoint {

/// Excess of a remark that no limit bounds, allowance of a gate without an edge.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Remark {
  bool error = true;  ///< else a warning, which turns nothing red
  int code = 0;       ///< exit code of the contract; 0 for a warning
  SourcePlace place;  ///< of the limit in the case file; line 0 = the file as a whole, no file = the suite
  std::string title;  ///< case and judged metric
  std::string text;   ///< one sentence
  /// How far beyond the limit, to put the worst first: share_of_limit(); infinite where there is no value
  double excess = 0.0;
  /// The verdict where nothing else is wrong: LOOSENED, CHANGED, GONE; empty = that of the code
  std::string word;
};

/// The word of the verdict: that of the remarks where all that give the code share one, else that of the
/// code.
[[nodiscard]] std::string verdict_word(int exit_code, const Results&, const std::vector<Remark>&);

/// Every gate that is not green, and every problem of a case or the suite, worst first.
[[nodiscard]] std::vector<Remark> verdict_remarks(const Results&);

/// "error: file:line: title: text", one line each.
[[nodiscard]] std::string remarks_text(const std::vector<Remark>&);

/// The same as workflow commands of GitHub (`::error file=...,line=...`), which it draws beside the line of
/// the limit. GitHub shows ten of a kind a step. So the ten worst errors are written, and the last says how
/// many more there are; then likewise the warnings.
[[nodiscard]] std::string annotations_text(const std::vector<Remark>&, std::size_t most = 10);

}  // namespace tripoint
