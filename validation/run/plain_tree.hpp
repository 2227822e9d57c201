// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>

/// Files that somebody else hands us in folders.
namespace tripoint {

/// A link would bring in files from elsewhere, and a pipe would keep us waiting. A path that does not exist
/// is plain.
/// @throws InputError naming the first thing in a tree, or its root, that is neither a file nor a folder
void expect_plain_tree(const std::filesystem::path& root);

/// Copies a folder into another, over files that are there. A link that appears meanwhile is not followed.
/// @throws InputError as above, before anything is copied
void copy_plain_tree(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tripoint
