// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace tripoint {

/// Sums of add(i, sums) over i = 0..count-1 in fixed blocks, and then block after block: the same bits whatever the threads.
/// @param blocks memory that is used again from call to call
template <std::size_t n, class Add>
[[nodiscard]] std::array<double, n> ordered_sums(std::size_t count, int threads, std::vector<std::array<double, n>>& blocks, Add add) {
  constexpr std::size_t block = 1024;
  blocks.assign((count + block - 1) / block, {});
#pragma omp parallel for schedule(static) num_threads(threads) if (blocks.size() > 1)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    std::array<double, n> sum{};  // here and not in place, so that it can be kept in registers
    for (std::size_t i = b * block; i < end; ++i) add(i, sum);
    blocks[b] = sum;
  }
  std::array<double, n> total{};
  for (const auto& part : blocks) {
    for (std::size_t k = 0; k < n; ++k) total[k] += part[k];
  }
  return total;
}

}  // namespace tripoint
