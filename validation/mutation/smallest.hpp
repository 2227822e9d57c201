// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>

#include "tables/words.hpp"

/// The least size of a defect that a gate sees, whichever its sign, by bisection.
namespace tripoint {

/// Result of a bisection: the gate is red at `size` and green at `hidden`, which is at most 5 % less.
struct SmallestVisible {
  std::optional<double> size;  ///< empty = the gate is green up to the greatest size that was asked for
  double hidden = 0.0;         ///< greatest size tried at which it is green
  int runs = 0;                ///< sizes tried
  bool found = false;          ///< false with a size: the gate is red however small the defect is
};

/// Ratio of the sizes between which bisection ends.
constexpr double smallest_resolution = 1.05;
/// A stored size may be passed by this factor before the self-test fails. A limit loosened, or a metric
/// blunted, by a quarter is seen. Twice the resolution of the bisection and another machine's round-off are
/// not.
constexpr double smallest_growth = 1.25;

/// Looks from `start` in ever longer strides for a size that is seen and one that is not, then halves the
/// ratio of the two.
/// @param seen whether the gate is red at a size > 0; it is taken to be red at every larger one
/// @param greatest no size beyond it is tried
[[nodiscard]] SmallestVisible smallest_visible(double start, double greatest,
                                               const std::function<bool(double)>& seen);

/// The least visible size beside the one that the case states. UNSEEN: no gate turns red. NEVER GREEN: the
/// gate is red at every size.
enum class Size { held, shrank, grew, unseen, never_green };
constexpr WordTable<5> word_table(Size) {
  return {"verdict on a smallest size", {"held", "shrank", "GREW", "UNSEEN", "NEVER GREEN"}};
}

/// Grew, shrank or held, against the stored size.
[[nodiscard]] Size against_stored(double now, double stored);

}  // namespace tripoint
