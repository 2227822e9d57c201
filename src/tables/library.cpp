// SPDX-License-Identifier: BSD-3-Clause
#include "tables/library.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

/// Where the program finds its shipped files: beside the executable, so that any working folder serves.
namespace tripoint {
namespace fs = std::filesystem;

std::string share_folder() {
  static const std::string folder = [] {
    std::error_code error;
    const auto exe = fs::read_symlink("/proc/self/exe", error);
    // bin/tripoint, tests/test-scene: one folder up; libexec/tripoint/engine-x: two
    fs::path at = error ? fs::current_path(error) : exe.parent_path();
    for (int i = 0; i < 4; ++i, at = at.parent_path())
      if (fs::is_directory(at / "share" / "tripoint", error)) return (at / "share" / "tripoint").string();
    return (exe.parent_path().parent_path() / "share" / "tripoint").string();
  }();
  return folder;
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(fs::path(share_folder()) / "cases" / "materials", error))
    if (file.path().extension() == ".toml") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string library_file(const std::string& material) {
  const auto names = library_names();  // only names that are listed: no path can be smuggled in
  if (!std::binary_search(names.begin(), names.end(), material)) return "";
  return (fs::path(share_folder()) / "cases" / "materials" / (material + ".toml")).string();
}

}  // namespace tripoint
