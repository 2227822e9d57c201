// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "core/machine.hpp"

namespace tripoint {

/// Rows from..to-1.
struct Rows {
  std::size_t from = 0, to = 0;
  [[nodiscard]] std::size_t count() const { return to - from; }
  [[nodiscard]] bool has(std::size_t row) const { return row >= from && row < to; }
};

/// body(i) for i = 0..count-1, shared among threads where there are enough. The thread library is not called
/// for a team of one. It would take memory at every call, a sixth of the instructions of a small scene's
/// step.
template <class Body>
void for_rows(std::size_t count, int threads, Body body) {
  if (threads == 1 || count <= worth_threads) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) body(i);
}
/// The same for these rows.
template <class Body>
void for_rows(const Rows& rows, int threads, Body body) {
  for_rows(rows.count(), threads, [&](std::size_t n) { body(rows.from + n); });
}

}  // namespace tripoint
