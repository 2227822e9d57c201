// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/shards.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/errors.hpp"
#include "queue/folder.hpp"

namespace tripoint {
namespace {

std::vector<QueuedJob> jobs_of_costs(const std::vector<double>& costs) {
  std::vector<QueuedJob> jobs;
  for (std::size_t n = 0; n < costs.size(); ++n) jobs.push_back(test::job(static_cast<int>(n), costs[n]));
  return jobs;
}

TEST(Shards, HoldEveryJobOnce) {
  std::mt19937 draw(7);
  std::vector<double> costs;
  for (int n = 0; n < 1000; ++n) costs.push_back(std::exponential_distribution<double>(0.1)(draw));
  const auto shards = balanced_shards(jobs_of_costs(costs), 7);
  std::vector<std::size_t> all;
  for (const auto& rows : shards) all.insert(all.end(), rows.begin(), rows.end());
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), costs.size());
  for (std::size_t n = 0; n < all.size(); ++n) EXPECT_EQ(all[n], n);
}

TEST(Shards, OfCostsThatGrowDifferByNoMoreThanOneJob) {
  std::vector<double> costs;
  for (int n = 1; n <= 100; ++n) costs.push_back(n);
  const auto jobs = jobs_of_costs(costs);
  const auto shards = balanced_shards(jobs, 4);
  // The least jobs are 1 to 4
  for (const auto& rows : shards) EXPECT_NEAR(cost_of(jobs, rows), 5050.0 / 4.0, 2.0);
}

// 2m + 1 jobs on m = 3: the longest shard is 4/3 - 1/(3m) = 11/9 of the best
TEST(Shards, AreTheExampleOfGraham) {
  const auto jobs = jobs_of_costs({5, 5, 4, 4, 3, 3, 3});
  double longest = 0.0;
  for (const auto& rows : balanced_shards(jobs, 3)) longest = std::max(longest, cost_of(jobs, rows));
  EXPECT_DOUBLE_EQ(longest, 11.0);
}

TEST(Shards, AreTheSameWhateverTheOrderOfTheJobs) {
  auto jobs = jobs_of_costs({3, 1, 4, 1, 5, 9, 2, 6});
  const auto ids = [](const std::vector<QueuedJob>& list, const std::vector<std::size_t>& rows) {
    std::vector<std::string> names;
    for (const auto row : rows) names.push_back(list[row].id);
    return names;
  };
  const auto before = ids(jobs, balanced_shards(jobs, 3)[1]);
  std::reverse(jobs.begin(), jobs.end());
  EXPECT_EQ(ids(jobs, balanced_shards(jobs, 3)[1]), before);
}

TEST(Shards, BatchShortJobsToATime) {
  const auto jobs = jobs_of_costs(std::vector<double>(200, 3.0));  // 600 s
  EXPECT_EQ(shards_of_seconds(jobs, 60.0, 1000), 10);
  EXPECT_EQ(shards_of_seconds(jobs, 60.0, 4), 4);
  EXPECT_EQ(shards_of_seconds(jobs, 0.001, 1000), 200);  // never more than jobs
  EXPECT_EQ(shards_of_seconds(jobs, 1e9, 1000), 1);
  EXPECT_THROW(static_cast<void>(balanced_shards(jobs, 0)), InputError);
}

}  // namespace
}  // namespace tripoint
