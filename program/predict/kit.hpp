// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint::predict {

/// One shell file that predicts and measures a case on a cluster and leaves result.json, for `sbatch` or
/// bash.
/// @param what the case as it was typed   @param ranks ascending
[[nodiscard]] std::string kit_script(const std::string& what, const std::vector<std::string>& set,
                                     const std::vector<int>& ranks);

}  // namespace tripoint::predict
