// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "validation/results/results.hpp"

/// Shards of a suite, made whole.
namespace tripoint {

/// Shards into one set of results. @throws InputError when a shard is missing, two overlap, or one holds a
/// link, a pipe or a device
[[nodiscard]] Results merge_shards(const std::vector<std::string>& folders);

/// Copies the runs of shards below `out`. @throws InputError for a link, a pipe or a device, before anything
/// of its shard is copied
void copy_runs_of_shards(const std::vector<std::string>& folders, const std::string& out);

}  // namespace tripoint
