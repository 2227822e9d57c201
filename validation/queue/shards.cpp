// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/shards.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "core/errors.hpp"

namespace tripoint {

std::vector<std::size_t> dearest_first(const std::vector<QueuedJob>& jobs) {
  std::vector<std::size_t> rows(jobs.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    return jobs[a].cost != jobs[b].cost ? jobs[a].cost > jobs[b].cost : jobs[a].id < jobs[b].id;
  });
  return rows;
}

std::vector<std::vector<std::size_t>> balanced_shards(const std::vector<QueuedJob>& jobs, int n) {
  if (n < 1) throw InputError("at least one shard is wanted");
  std::vector<std::vector<std::size_t>> shards(static_cast<std::size_t>(n));
  using Load = std::pair<double, std::size_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (std::size_t k = 0; k < shards.size(); ++k) least.push({0.0, k});
  for (const auto row : dearest_first(jobs)) {
    auto [load, k] = least.top();
    least.pop();
    shards[k].push_back(row);
    least.push({load + jobs[row].cost, k});
  }
  return shards;
}

double cost_of(const std::vector<QueuedJob>& jobs, const std::vector<std::size_t>& rows) {
  return std::accumulate(rows.begin(), rows.end(), 0.0,
                         [&](double sum, std::size_t row) { return sum + jobs[row].cost; });
}

int shards_of_seconds(const std::vector<QueuedJob>& jobs, double seconds, int most) {
  const double whole = std::accumulate(jobs.begin(), jobs.end(), 0.0,
                                       [](double sum, const QueuedJob& job) { return sum + job.cost; });
  const double wanted = std::ceil(whole / seconds),
               at_most = std::min(static_cast<double>(most), static_cast<double>(jobs.size()));
  return std::max(1, static_cast<int>(std::min(wanted, at_most)));
}

}  // namespace tripoint
