// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <set>
#include <string>

/// What lies in a folder that somebody else fills: its size, and its removal. Neither is fooled by folders
/// that nest without end, nor by folders that are closed to their owner.
namespace tripoint {

struct FolderSums {
  double bytes = 0.0;       ///< of the disk
  std::size_t entries = 0;  ///< files and folders
  std::string unseen;       ///< why some of it was not counted, in words; empty where all was
};

/// Counts until there are more entries than are enough.
[[nodiscard]] FolderSums sums_of_folder(const std::string& folder, std::size_t enough);

/// Removes all that lies in a folder, but for entries of these names. It takes few open files, however deep
/// folders nest: each is first brought up. Errors leave the rest in place.
void remove_flat(const std::string& folder, std::set<std::string> kept);

}  // namespace tripoint
