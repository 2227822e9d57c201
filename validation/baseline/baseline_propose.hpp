// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/baseline/baseline.hpp"

/// Baselines as they would be if results were accepted, and the patch that shows them. Nothing here writes a
/// baseline.
namespace tripoint {

/// Reason of a proposal that nobody has decided on. A baseline that carries it last is red (exit 4), so that
/// a patch applied as it comes accepts nothing.
inline constexpr const char* undecided_reason = "proposed by tripoint gate propose; nobody has decided";

/// One baseline before and after.
struct Proposal {
  std::string id, file;
  std::string before, after;  ///< texts of the file; `before` empty = there is none yet
  std::string changes;        ///< each limit, metric and value that changes, a line each
  std::string removed;        ///< gates that would be let go, a line each
  double loosened = 0.0;      ///< sum of ln(new/old) of all loosenings since the first baseline
  int limits_loosened = 0, limits_removed = 0;
};

/// @param ids of the cases; empty = all
/// @throws InputError for an id that the results do not hold, where a case is not green, where no reason is
/// given, and where accepted rows are lacking
[[nodiscard]] std::vector<Proposal> proposals(const Results&, const std::vector<std::string>& ids,
                                              const Acceptance&, const Lacking& = {});

/// A unified diff of two texts with three lines of context and no file header; empty where they are the same.
[[nodiscard]] std::string unified_diff(const std::string& before, const std::string& after);

/// The patch for `git apply` in the folder that the paths are relative to. Text above it says what changes,
/// and the line that accepts it.
/// @param root folder of the repository: the nearest above the baselines that holds .git, else the one that
/// holds `baselines`
[[nodiscard]] std::string patch_text(const std::vector<Proposal>&, const std::string& results_file,
                                     const std::string& root, bool undecided);

/// The folder that the paths of a patch are relative to.
[[nodiscard]] std::string patch_root(const std::string& baseline);

}  // namespace tripoint
