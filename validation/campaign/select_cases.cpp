// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "tables/toml_node.hpp"
#include "validation/campaign/case_names.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

struct Found {
  std::string path;
  bool by_name = false;  ///< a file or id that was asked for, whatever its profile
};

/// Not a case: reference data beside a case (NAME.ref.*), the material library, and baselines, which lie
/// among cases where their folder has another name than `cases`.
bool is_case(const fs::path& file, const fs::path& folder) {
  const auto below = file.lexically_relative(folder).parent_path();
  return file.extension() == ".toml" && file.filename().string().find(".ref.") == std::string::npos &&
         file.parent_path().filename() != "materials" &&
         std::find(below.begin(), below.end(), "baselines") == below.end();
}

std::vector<Found> files_below(const fs::path& folder) {
  std::vector<Found> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::follow_directory_symlink))
    if (entry.is_regular_file() && is_case(entry.path(), folder))
      files.push_back({entry.path().string(), false});
  return files;
}

std::vector<Found> files_for(const std::string& what) {
  std::error_code none;
  const auto subject = subject_folder(what);
  if (fs::is_directory(what, none)) {
    auto files = files_below(what);
    // a folder of runs that has a subject's name is not meant
    return files.empty() && !subject.empty() ? files_below(subject) : files;
  }
  const bool is_file = fs::exists(what, none) || fs::is_regular_file(what + ".toml", none);
  if (!is_file && !subject.empty()) return files_below(subject);
  return {{case_file(what), true}};
}

std::vector<Found> all_files(const std::vector<std::string>& what) {
  const fs::path own = fs::path(share_folder()) / "cases";
  if (what.empty())
    return fs::is_directory(own) ? files_below(own)
                                 : throw InputError(own.string() + ": the folder of cases is missing");
  std::vector<Found> files;
  for (const auto& w : what)
    for (auto& f : files_for(w)) files.push_back(std::move(f));
  return files;
}

void try_together(const std::vector<Found>& files) {
  std::vector<std::string> paths;
  for (const auto& file : files) paths.push_back(file.path);
  if (paths.size() > 1) try_toml_files(paths);
}

bool matches(const CaseFilter& filter, const Case& value, bool by_name) {
  const auto has = [](const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  if (!filter.tag.empty() && !has(value.tags, filter.tag)) return false;
  if (value.id.find(filter.substring) == std::string::npos) return false;
  if (filter.only && !has(*filter.only, value.id)) return false;
  return by_name || filter.profile.empty() || has(value.profiles, filter.profile);
}

std::string describe(const CaseFilter& filter) {
  std::string text =
      filter.what.empty() ? "the cases beside the program" : fmt::format("{}", fmt::join(filter.what, ", "));
  if (!filter.profile.empty()) text += ", profile " + filter.profile;
  if (!filter.tag.empty()) text += ", tag " + filter.tag;
  if (!filter.substring.empty()) text += ", an id with \"" + filter.substring + "\" in it";
  if (filter.only) text += ", among those that failed last time";
  return text;
}

}  // namespace

std::string shown_path(const std::string& path) {
  std::error_code none;
  const auto real = fs::canonical(path, none);
  if (none) return path;
  const auto below = fs::relative(real, fs::current_path(none), none);
  return none || below.empty() || *below.begin() == ".." ? real.string() : below.string();
}

std::vector<Case> select_cases(const CaseFilter& filter) {
  std::map<std::string, Case> by_id;
  std::set<std::string> tags;
  const auto files = all_files(filter.what);
  try_together(files);
  for (const auto& file : files) {
    auto value = read_case(shown_path(file.path)).value;
    tags.insert(value.tags.begin(), value.tags.end());
    if (!matches(filter, value, file.by_name)) continue;
    const auto [at, is_new] = by_id.emplace(value.id, value);
    if (!is_new && at->second.file != value.file)
      throw InputError(
          fmt::format("{}: the id {} is already that of {}", value.file, value.id, at->second.file));
  }
  const bool no_such_tag = !filter.tag.empty() && tags.count(filter.tag) == 0;
  if (by_id.empty())
    throw NothingSelected("no case matches " + describe(filter) +
                          (no_such_tag ? suggestion(filter.tag, {tags.begin(), tags.end()}) : ""));
  std::vector<Case> chosen;
  int index = 0;
  for (auto& [id, value] : by_id)
    if (index++ % filter.shards == filter.shard - 1) chosen.push_back(std::move(value));
  return chosen;
}

}  // namespace tripoint
