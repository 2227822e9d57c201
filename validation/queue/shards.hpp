// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/queue/queue.hpp"

/// Jobs shared out to shards of nearly equal predicted cost. A shard is a rule, not a file: every machine
/// works out the same one.
namespace tripoint {

/// Rows of queue.jobs for each of n shards. The dearest job goes to the shard that has least so far (ties:
/// the first shard, the lower id). So no shard costs more than 4/3 of the best possible [Graham 1969].
/// @throws InputError where n < 1
[[nodiscard]] std::vector<std::vector<std::size_t>> balanced_shards(const std::vector<QueuedJob>&, int n);

/// Rows in the order in which they are best begun: dearest first.
[[nodiscard]] std::vector<std::size_t> dearest_first(const std::vector<QueuedJob>&);

/// How many shards make one of about `seconds` of predicted cost; at least 1, at most one a job and `most`.
[[nodiscard]] int shards_of_seconds(const std::vector<QueuedJob>&, double seconds, int most);

[[nodiscard]] double cost_of(const std::vector<QueuedJob>&, const std::vector<std::size_t>& rows);

}  // namespace tripoint
