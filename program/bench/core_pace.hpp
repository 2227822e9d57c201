// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace tripoint::bench {

/// How fast cores are now. A core may lose width for a while, because a program outside this machine uses the
/// other thread of it, or time, because other work is on it. Both show in a loop of independent operations,
/// pinned to each core.
class CorePace {
 public:
  /// Takes 0.3 s to learn what is fast. @param cores that are looked at, at once: the first of those that
  /// this process may use, at least one
  explicit CorePace(int cores);

  /// One look of some 15 ms. @return time of the loop on the slowest core, over that of the tenth of all
  /// looks that were fastest: about 1 where it is fast
  double look();
  /// Looks until all cores are fast. @param patience [s] for how long at most   @param stop asked between
  /// looks: whether to end
  /// @return seconds that it took beyond the first look; all of the patience where they have not become fast
  double wait_until_fast(double patience, bool (*stop)() noexcept);

  [[nodiscard]] int looks() const { return looks_; }
  [[nodiscard]] int slow_looks() const { return slow_looks_; }

 private:
  int cores_;
  std::vector<double> times_;  ///< of all looks, in rising order: of the loop on the slowest core [s]
  int looks_ = 0, slow_looks_ = 0;
};

}  // namespace tripoint::bench
