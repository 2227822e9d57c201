// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "core/machine.hpp"
#include "state/state.hpp"

namespace tripoint {

/// The rows of a column that are awake.
template <class T>
[[nodiscard]] std::span<T> awake(Particles& p, const Field<T>& field) {
  return p[field].first(p.awake());
}

/// Some rows of a column.
template <class T>
[[nodiscard]] std::span<T> part(std::span<T> column, const Rows& rows) {
  return column.subspan(rows.from, rows.count());
}

/// Sets a column, shared among threads where it is long enough.
inline void fill(std::span<double> column, double value, int threads) {
#pragma omp parallel for schedule(static) num_threads(threads) if (column.size() > worth_threads)
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = value;
}

}  // namespace tripoint
