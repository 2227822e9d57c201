// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/errors.hpp"
#include "validation/judge/judge.hpp"
#include "validation/run/plain_tree.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

/// Every shard i/n of one n must be there once: fewer cases than were asked for must not look like a whole
/// suite.
void check_shards(const std::vector<std::string>& folders, const std::vector<Results>& parts) {
  std::set<std::string> shards;
  std::size_t wanted = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto& shard = parts[k].shard;
    if (shard.empty()) throw InputError(folders[k] + ": was not made with --shard i/n");
    if (!shards.insert(shard).second)
      throw InputError(fmt::format("{}: shard {} is given twice", folders[k], shard));
    const auto n = static_cast<std::size_t>(std::stoul(shard.substr(shard.find('/') + 1)));
    if (wanted != 0 && n != wanted)
      throw InputError(
          fmt::format("{}: shard {} belongs to another set than {}", folders[k], shard, parts.front().shard));
    wanted = n;
  }
  if (parts.size() != wanted)
    throw InputError(fmt::format("{} of {} shards are given", parts.size(), wanted));
}

void check_same_question(const std::vector<std::string>& folders, const std::vector<Results>& parts) {
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const auto &a = parts.front(), &b = parts[k];
    if (a.profile != b.profile || a.seed != b.seed || a.only_engines != b.only_engines ||
        a.asked != b.asked || a.what != b.what || a.tag != b.tag || a.tool.commit != b.tool.commit)
      throw InputError(
          fmt::format("{}: was made with another profile, seed, choice of engines or commit than {}",
                      folders[k], folders.front()));
  }
}

}  // namespace

Results merge_shards(const std::vector<std::string>& folders) {
  for (const auto& folder : folders)
    for (const char* taken : {"results.json", "runs"}) expect_plain_tree(fs::path(folder) / taken);
  std::vector<Results> parts;
  for (const auto& folder : folders)
    parts.push_back(read_results((fs::path(folder) / "results.json").string()));
  if (parts.empty()) throw InputError("no folder of a shard is given");
  check_shards(folders, parts);
  check_same_question(folders, parts);
  Results whole = parts.front();
  whole.interrupted = false;  // parts that a stopped shard lacks are missing in the whole
  whole.shard.clear();
  whole.history.clear();
  whole.cases.clear();
  whole.planned.clear();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::move(parts[k].cases.begin(), parts[k].cases.end(), std::back_inserter(whole.cases));
    whole.planned.insert(whole.planned.end(), parts[k].planned.begin(), parts[k].planned.end());
  }
  std::sort(whole.cases.begin(), whole.cases.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  std::sort(whole.planned.begin(), whole.planned.end());
  judge(whole);
  return whole;
}

void copy_runs_of_shards(const std::vector<std::string>& folders, const std::string& out) {
  for (const fs::path folder : folders)
    if (fs::exists(folder / "runs") && !fs::equivalent(folder, out))
      copy_plain_tree(folder / "runs", fs::path(out) / "runs");
}

}  // namespace tripoint
