// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tables/library.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/results/verdict.hpp"

/// What a change may not do to the suite that judges it.
namespace tripoint {
namespace fs = std::filesystem;
namespace {

Remark remark(const fs::path& file, const std::string& title, const std::string& text,
              const std::string& word) {
  return {true, exit_missing, {file.string(), 1, 0}, title, text, infinity, word};
}

bool is_link(const fs::path& path) {
  std::error_code none;
  return fs::is_symlink(path, none);
}

/// Folders and files of cases and baselines that the results are of. The program's own cases may lie behind a
/// link: nobody proposes those.
std::set<fs::path> places_of(const Results& results) {
  std::set<fs::path> places;
  std::error_code none;
  const auto own = fs::weakly_canonical(fs::path(share_folder()) / "cases", none);
  const auto add = [&](const fs::path& place) {
    auto plain = place.lexically_normal();
    if (!plain.has_filename()) plain = plain.parent_path();  // "cases/" is the link `cases` itself
    if (fs::exists(plain, none) && fs::weakly_canonical(plain, none) != own) places.insert(plain);
  };
  for (const auto& w : results.what) add(w);
  for (const auto& c : results.cases) {
    const fs::path folder = folder_of_cases(c.file);
    add(folder.filename() == "cases" ? folder : fs::path(c.file));
    add(baseline_folder(c.file));
  }
  return places;
}

/// In a folder of another name lie other things too: there a link is one of a case only by its ending.
void add_links(const fs::path& place, std::set<fs::path>& links) {
  std::error_code none;
  if (is_link(place)) links.insert(fs::absolute(place, none));
  if (!fs::is_directory(place, none)) return;
  const bool all = place.filename() == "cases" || place.filename() == "baselines";
  for (fs::recursive_directory_iterator at(place, none), end; at != end; at.increment(none))
    if (is_link(at->path()) && (all || at->path().extension() == ".toml"))
      links.insert(fs::absolute(at->path(), none).lexically_normal());
}

void name_links(const Results& results, std::vector<Remark>& list) {
  std::set<fs::path> links;
  for (const auto& place : places_of(results)) add_links(place, links);
  for (const auto& link : links)
    list.push_back(remark(link, link.filename().string(),
                          "is a link, and could lead to an easier case than the one that was accepted: a "
                          "case and its baseline are "
                          "files of their own",
                          "CHANGED"));
}

void name_lost_baselines(const Results& results, const std::string& root, std::vector<Remark>& list) {
  for (const auto& c : results.cases) {
    const auto here = baseline_file(c.file), there = baseline_file(c.file, root);
    if (fs::exists(there) && !fs::exists(here))
      list.push_back(
          remark(c.file, c.id,
                 fmt::format(
                     "its baseline {} is gone, and {} has it: tripoint gate accept --reason says who decided "
                     "and why",
                     fs::path(here).lexically_relative(fs::current_path()).string(), there),
                 "GONE"));
  }
}

/// Baselines of the root whose case is there and was not judged, in a profile that was run.
void name_unjudged(const Results& results, const std::string& root, std::vector<Remark>& list) {
  if (!results.shard.empty() || results.cases.empty()) return;
  const fs::path cases = folder_of_cases(results.cases.front().file);
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".toml") continue;
    const auto b = read_baseline(entry.path().string());
    const bool due = results.profile.empty() ||
                     std::find(b.profiles.begin(), b.profiles.end(), results.profile) != b.profiles.end();
    const bool judged = std::any_of(results.cases.begin(), results.cases.end(), [&](const auto& c) {
      return fs::path(baseline_file(c.file, root)) == entry.path();
    });
    if (due && !judged && fs::exists(cases / fs::relative(entry.path(), root)))
      list.push_back(remark(
          entry.path(), b.id,
          "has accepted figures, and is not among these results: run the whole folder of cases", "GONE"));
  }
}

}  // namespace

std::vector<Remark> suite_remarks(const Results& results, bool required, const std::string& root) {
  std::vector<Remark> list;
  name_links(results, list);
  if (root.empty()) return list;
  name_lost_baselines(results, root, list);
  if (required) name_unjudged(results, root, list);
  return list;
}

}  // namespace tripoint
