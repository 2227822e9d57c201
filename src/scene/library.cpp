// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "scene/readers.hpp"

/// Where the program finds what it ships: beside the executable, so that any working folder serves.
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

std::string case_path(const std::string& path_or_id) {
  std::error_code error;
  if (fs::exists(path_or_id, error)) return path_or_id;
  const auto shipped = fs::path(share_folder()) / "cases" / (path_or_id + ".toml");
  return fs::is_regular_file(shipped, error) ? shipped.string() : path_or_id;
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& file : fs::directory_iterator(fs::path(share_folder()) / "cases" / "materials", error))
    if (file.path().extension() == ".toml") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Finding> library_values(const CaseReading& reading) {
  std::vector<Finding> found;
  for (const Material& m : reading.value.scene.materials) {
    if (library_file(m.name).empty()) continue;
    const std::string table = "material." + m.name + ".", from = "library, ";
    std::string taken;
    bool is_table = false;  // not the bare name in a body
    SourcePlace place;
    for (const Decision& d : reading.decisions) {
      if (d.key.rfind(table, 0) != 0) continue;
      const std::string key = d.key.substr(table.size());
      if (d.given && key == "name") place = d.place;
      is_table = is_table || (d.given && key != "name");
      if (!d.given && d.reason.rfind(from, 0) == 0 && key != "source")
        taken += (taken.empty() ? "" : ", ") + key + " = " + d.value;
    }
    if (is_table && !taken.empty())
      found.push_back({false,
                       "material \"" + m.name + "\" takes what it does not give from the library's material of that name: " +
                           taken + "; name it otherwise to have none of these",
                       place});
  }
  return found;
}

std::string library_file(const std::string& material) {
  const auto names = library_names();  // only names that are listed: no path can be smuggled in
  if (!std::binary_search(names.begin(), names.end(), material)) return "";
  return (fs::path(share_folder()) / "cases" / "materials" / (material + ".toml")).string();
}

}  // namespace tripoint
