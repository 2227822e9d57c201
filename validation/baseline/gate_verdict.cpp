// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/gate_verdict.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/errors.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/campaign/recheck.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {
namespace fs = std::filesystem;

bool holds_baselines(const std::string& folder) {
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::follow_directory_symlink))
    if (entry.path().extension() == ".toml") return true;
  return false;
}

}  // namespace

GateVerdict gate_verdict(const Results& results, const std::string& baselines, bool require_baselines) {
  if (!baselines.empty() && !fs::is_directory(baselines))
    throw InputError("--baselines " + baselines + ": is no folder");
  if (!baselines.empty() && !holds_baselines(baselines))
    throw InputError("--baselines " + baselines +
                     ": holds no baseline (SUBJECT/CASE.toml), and nothing would be judged by it");
  GateVerdict verdict;
  auto remarks = verdict_remarks(results);
  for (const auto& list :
       {recheck_remarks(results), headroom_remarks(results),
        baseline_remarks(results, require_baselines, baselines), lost_case_remarks(results, baselines),
        suite_remarks(results, require_baselines, baselines), engine_remarks(results, baselines)})
    remarks.insert(remarks.end(), list.begin(), list.end());
  if (const auto commit = this_tool().commit; results.tool.commit != commit)
    remarks.push_back(
        {false,
         0,
         {},
         "the results",
         fmt::format(
             "were made by commit {}, and this program is of {}: validate again to judge what is here",
             results.tool.commit, commit),
         1.0,
         {}});
  if (!results.shard.empty() && !results.shard.ends_with("/1"))
    remarks.push_back(
        {false,
         0,
         {},
         "the results",
         fmt::format("are part {} of a suite: tripoint merge joins the parts, and the whole is judged",
                     results.shard),
         1.0,
         {}});
  if (!results.filter_known && !results.cases.empty())
    remarks.push_back({false,
                       0,
                       {},
                       "the results",
                       "are of chosen cases (-k, --last-failed, or another command than validate): what was "
                       "left out is not judged here",
                       1.0,
                       {}});
  add_remarks(verdict, results, std::move(remarks));
  for (const auto& [name, count] : accepted_but_absent(results, baselines))
    verdict.absent += fmt::format(
        "{}{} of {}", verdict.absent.empty() ? "; accepted gates that are not judged here: " : ", ", count,
        name);
  return verdict;
}

void add_remarks(GateVerdict& verdict, const Results& results, std::vector<Remark> more) {
  verdict.remarks.insert(verdict.remarks.end(), more.begin(), more.end());
  std::set<int> codes{results.exit_code};
  for (const auto& r : verdict.remarks)
    if (r.error) codes.insert(r.code);
  verdict.code = first_of(codes);
  verdict.word = verdict_word(verdict.code, results, verdict.remarks);
}

}  // namespace tripoint
