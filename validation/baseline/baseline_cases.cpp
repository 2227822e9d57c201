// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "validation/baseline/baseline_rows.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// A folder of baselines and the folder of the cases that they are of.
struct Suite {
  std::string baselines, cases;
  auto operator<=>(const Suite&) const = default;
};

std::set<Suite> suites_of(const Results& results, const std::string& root) {
  std::set<Suite> suites;
  for (const auto& c : results.cases) {
    const auto folder = root.empty() ? baseline_folder(c.file) : root;
    if (fs::is_directory(folder)) suites.insert({folder, folder_of_cases(c.file)});
  }
  return suites;
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The case of a baseline: in the folder of the cases. As both may share one folder `baselines`, it may also
/// be beside the folder `cases` or below it.
fs::path case_of(const fs::path& baseline, const Suite& suite) {
  const auto below = fs::relative(baseline, suite.baselines);
  const fs::path folder(suite.cases);
  const auto other = folder.filename() == "cases" ? folder.parent_path() : folder / "cases";
  return fs::exists(folder / below) || !fs::exists(other / below) ? folder / below : other / below;
}

Remark lost(const Baseline& b, const fs::path& file, const std::string& what) {
  return {true,
          exit_missing,
          {file.string(), 1, 0},
          b.id,
          what + ": tripoint gate accept --reason says who decided and why",
          infinity,
          "GONE"};
}

/// A case that the whole profile was to run is judged, not only there.
bool was_due(const Results& results, const Baseline& b) {
  const bool whole = results.filter_known && results.what.empty() && results.tag.empty() &&
                     results.shard.empty() && !results.profile.empty();
  return whole && std::find(b.profiles.begin(), b.profiles.end(), results.profile) != b.profiles.end();
}

}  // namespace

std::vector<Remark> lost_case_remarks(const Results& results, const std::string& root) {
  std::vector<Remark> list;
  for (const auto& suite : suites_of(results, root))
    for (const auto& file : files_below(suite.baselines)) {
      const auto b = read_baseline(file.string());
      const auto of = case_of(file, suite);
      if (!fs::exists(of)) {
        list.push_back(lost(b, file,
                            fmt::format("has a baseline of {} gates, and its case {} is no more",
                                        b.gates.size(), of.string())));
        continue;
      }
      const auto hashes = case_hashes(of.string());
      if (!hashes) {
        list.push_back(lost(b, file, "has a baseline, and its case cannot be read"));
        continue;
      }
      for (const auto& profile : b.profiles)
        if (std::find(hashes->profiles.begin(), hashes->profiles.end(), profile) == hashes->profiles.end())
          list.push_back(lost(
              b, file,
              fmt::format("was accepted in the profile {}, and its case is not in it any more", profile)));
      if (was_due(results, b) && std::none_of(results.cases.begin(), results.cases.end(),
                                              [&](const auto& c) { return c.id == b.id; }))
        list.push_back(
            lost(b, file,
                 fmt::format("was accepted in the profile {}, and the results of that profile do not hold it",
                             results.profile)));
    }
  return list;
}

std::map<std::string, int> accepted_but_absent(const Results& results, const std::string& root) {
  std::map<std::string, int> counts;
  for (const auto& c : results.cases) {
    const auto file = baseline_file(c.file, root);
    if (!fs::exists(file)) continue;
    for (const auto& g : read_baseline(file).gates)
      if (is_absent(c, g, !results.only_engines.empty())) ++counts[g.engine];
  }
  return counts;
}

}  // namespace tripoint
