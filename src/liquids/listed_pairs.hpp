// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "particles/neighbours.hpp"

namespace tripoint::liquid {

/// A neighbour, as in Entry.
struct ListedPair {
  std::uint32_t row, image;
};

/// r_j - r_i of a pair [m], in the order of sums that makes it exactly antisymmetric in i and j. @param x
/// places by row [m]
template <class Places, class Pair>
[[nodiscard]] Vec3 way_to(const Neighbours& lists, const Places& x, std::size_t i, const Pair& pair) {
  return (x.at(pair.row) - x.at(i)) + lists.shift(pair.image);
}

/// Pairs of a few rows to which an effect adds something after a fused pass. They are found once for each
/// rebuild of the neighbour lists, and keep their order. A sum over them has the same bits for any number of
/// threads.
/// @tparam Pair has at least `row` and `image`, as ListedPair
template <class Pair = ListedPair>
class ListedPairs {
 public:
  /// Groups or rows have changed: the next renew() drops the listed pairs.
  void clear() noexcept { known_ = never; }
  /// Drops all pairs where they are of other neighbour lists, or clear() was called. @param rebuilds
  /// Neighbours::rebuilds() of now
  /// @return whether it dropped them, so that the caller lists them again
  [[nodiscard]] bool renew(long rebuilds) {
    if (known_ == rebuilds) return false;
    known_ = rebuilds;
    rows_.clear();
    start_.assign(1, 0);
    pairs_.clear();
    return true;
  }
  /// Adds a pair of the row that end_row() names next.
  void add(const Pair& pair) { pairs_.push_back(pair); }
  /// Whether a pair was added since the last row.
  [[nodiscard]] bool has_open_row() const noexcept { return pairs_.size() > start_.back(); }
  /// The pairs added since the last row are those of this row, perhaps none.
  void end_row(std::uint32_t row) {
    rows_.push_back(row);
    start_.push_back(pairs_.size());
  }

  [[nodiscard]] std::size_t rows() const noexcept { return rows_.size(); }    ///< how many rows are listed
  [[nodiscard]] std::size_t pairs() const noexcept { return pairs_.size(); }  ///< of all rows
  /// @param n number of a listed row, below rows()
  [[nodiscard]] std::uint32_t row(std::size_t n) const noexcept { return rows_[n]; }
  /// First of the pairs of that row, counted over all rows.
  [[nodiscard]] std::size_t first(std::size_t n) const noexcept { return start_[n]; }
  [[nodiscard]] std::span<const Pair> of(std::size_t n) const noexcept {
    return std::span(pairs_).subspan(start_[n], start_[n + 1] - start_[n]);
  }
  /// Calls visit(n) for each listed row, from several threads. @pre visit writes to that row alone
  template <class Visit>
  void each_row(int threads, Visit visit) const {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (std::size_t n = 0; n < rows_.size(); ++n) visit(n);
  }

 private:
  static constexpr long never = -1;  ///< no count of rebuilds
  std::vector<std::uint32_t> rows_;
  std::vector<std::size_t> start_{0};  ///< first pair of each row, and one past the last
  std::vector<Pair> pairs_;
  long known_ = never;  ///< the rebuild that the pairs are of
};

}  // namespace tripoint::liquid
