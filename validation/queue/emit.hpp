// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/queue/queue.hpp"

/// Scripts for schedulers. Each starts `tripoint suite work DIR --shard k/n` for every k, then merges; which
/// jobs are in a shard is worked out there.
namespace tripoint {

struct EmitOptions {
  std::string program;  ///< path of tripoint
  std::string dir;      ///< of the suite, absolute
  std::string typed;    ///< DIR as it was typed, for machines that share no folder
  int shards = 1;
  std::vector<int> numbers;  ///< of the shards that are to be started, from 1
  double longest = 0.0;      ///< predicted cost of the dearest shard [CPU s]
};

/// "slurm", "hyperqueue", "parallel", "snakemake", "github".
[[nodiscard]] std::vector<std::string> schedulers();

/// @throws InputError for another name
[[nodiscard]] std::string script_for(const std::string& scheduler, const Queue&, const EmitOptions&);

}  // namespace tripoint
