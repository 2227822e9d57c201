// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tripoint {

/// Of `tripoint merge`: the folders of shards, or the one folder of a suite.
struct MergeOptions {
  std::vector<std::string> folders;
  std::string out;
  bool page = true, json = false, sandbox = false;
};

/// Judges a suite whose jobs are done, and writes its report into its folder or `out`. @return the exit code
/// of its verdict
[[nodiscard]] int merge_suite(const std::string& folder, const MergeOptions&);

/// Adds the command `merge` to a group. @param earlier its spelling there, where it is one of an earlier
/// version; else empty
void add_merge_to(CLI::App& group, int& exit_code, const std::string& earlier);

}  // namespace tripoint
