// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline.hpp"

#include <filesystem>
#include <fstream>

namespace tripoint {
namespace fs = std::filesystem;
namespace {

struct Place {
  /// The folder of the suite's baselines, the file below it, the folder of its cases
  fs::path baselines, below, cases;
};

Place place_of(const std::string& case_file) {
  std::error_code none;
  auto file = fs::weakly_canonical(fs::path(case_file), none);
  if (none) file = case_file;
  fs::path below = file.filename();
  for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() == "cases") return {folder.parent_path() / "baselines", below, folder};
    below = folder.filename() / below;
  }
  return {file.parent_path() / "baselines", file.filename(), file.parent_path()};
}

}  // namespace

std::string baseline_file(const std::string& case_file, const std::string& root) {
  const auto place = place_of(case_file);
  return ((root.empty() ? place.baselines : fs::path(root)) / place.below).string();
}

std::string baseline_folder(const std::string& case_file) { return place_of(case_file).baselines.string(); }
std::string folder_of_cases(const std::string& case_file) { return place_of(case_file).cases.string(); }

bool keeps_baselines(const std::string& case_file) {
  std::error_code none;
  return fs::is_directory(place_of(case_file).baselines, none);
}

std::string text_of_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace tripoint
