// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "state/state.hpp"

namespace tripoint {
namespace detail {

/// Adds rows from..to-1: by add.rows(from, to, sums) where it has that, else one after the other.
template <std::size_t n, class Add>
[[gnu::always_inline]] inline void add_rows(const Add& add, std::size_t from, std::size_t to,
                                            std::array<double, n>& sums) {
  if constexpr (requires { add.rows(from, to, sums); })
    add.rows(from, to, sums);
  else
    for (std::size_t i = from; i < to; ++i) add(i, sums);
}

template <std::size_t n>
std::array<double, n> total_of(const std::vector<std::array<double, n>>& blocks) {
  std::array<double, n> total{};
  for (const auto& part : blocks) {
    for (std::size_t k = 0; k < n; ++k) total[k] += part[k];
  }
  return total;
}

}  // namespace detail

/// Sums of add(i, sums) over i = 0..count-1 in fixed blocks, and then block after block: the same bits
/// whatever the threads.
/// @param blocks memory that is used again from call to call
template <std::size_t n, class Add>
[[nodiscard]] std::array<double, n> ordered_sums(std::size_t count, int threads,
                                                 std::vector<std::array<double, n>>& blocks, Add add) {
  constexpr std::size_t block = 1024;
  blocks.assign((count + block - 1) / block, {});
#pragma omp parallel for schedule(static) num_threads(threads) if (blocks.size() > 1)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    std::array<double, n> sum{};  // here and not in place, so that it can be kept in registers
    const Add add_row = add;      // likewise
    detail::add_rows(add_row, b * block, end, sum);
    blocks[b] = sum;
  }
  return detail::total_of(blocks);
}

namespace detail {

/// add() works on every row, ghosts too, and of these its sums are left out: they are their owners'. Rows go
/// by runs of one kind, so that the loop over each asks nothing of a row.
template <std::size_t n, class Add>
[[nodiscard]] std::array<double, n> ordered_sums_of_own(const State& state,
                                                        std::vector<std::array<double, n>>& blocks, Add add) {
  constexpr std::size_t block = 1024;
  const std::size_t count = state.particles.size();
  blocks.assign((count + block - 1) / block, {});
#pragma omp parallel for schedule(static) num_threads(state.threads) if (blocks.size() > 1)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    std::array<double, n> own{}, of_copies{};
    const Add add_row = add;
    for (std::size_t i = b * block; i < end;) {
      const bool owns = state.owns(i);
      std::size_t past = i + 1;
      while (past < end && state.owns(past) == owns) ++past;
      add_rows(add_row, i, past, owns ? own : of_copies);
      i = past;
    }
    blocks[b] = own;
  }
  return total_of(blocks);
}

}  // namespace detail

/// The same over the rows that move, with the bits of a sum over all: fixed rows must add zeros.
template <std::size_t n, class Add>
[[nodiscard]] std::array<double, n> ordered_sums(const State& state,
                                                 std::vector<std::array<double, n>>& blocks, Add add) {
  const Particles& p = state.particles;
  if (!state.ghosts.empty()) return detail::ordered_sums_of_own(state, blocks, add);
  if (p.moving() == p.size()) return ordered_sums(p.size(), state.threads, blocks, add);
  const std::span<const std::uint32_t> first = state.neighbours->row_blocks();
  blocks.assign(first.size() - 1, {});
#pragma omp parallel for schedule(static) num_threads(state.threads) if (blocks.size() > 1)
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::array<double, n> sum{};
    const Add add_row = add;
    detail::add_rows(add_row, first[b], first[b + 1], sum);
    blocks[b] = sum;
  }
  return detail::total_of(blocks);
}

/// The same over all rows, fixed ones too.
template <std::size_t n, class Add>
[[nodiscard]] std::array<double, n> ordered_sums_of_all(const State& state,
                                                        std::vector<std::array<double, n>>& blocks, Add add) {
  const Particles& p = state.particles;
  if (!state.ghosts.empty()) return detail::ordered_sums_of_own(state, blocks, add);
  if (p.moving() == p.size()) return ordered_sums(p.size(), state.threads, blocks, add);
  const std::vector<std::uint32_t> rows = state.neighbours->rows_in_order(p);
  return ordered_sums(rows.size(), state.threads, blocks,
                      [&](std::size_t k, std::array<double, n>& sum) { add(rows[k], sum); });
}

}  // namespace tripoint
