// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/dimensions.hpp"

namespace tripoint::carried_liquid {

/// Share of the kernel sum of a full neighbourhood that is left at a free surface. The sum alone cannot tell
/// a surface from a liquid that is spread thin; its slope can. Of r = h |grad S|/S it is 1 - a r - b r^2,
/// exact at the two outer layers of a lattice under a flat surface (model 8.12).
class SurfaceFill {
 public:
  /// @param support_ratio h/dx
  SurfaceFill(double support_ratio, Dimensions);
  /// @param r h |grad S|/S, 0 inside   @return (0, 1]
  [[nodiscard]] double operator()(double r) const noexcept {
    const double bound = r < steepest ? r : steepest;
    return 1.0 - bound * (a_ + bound * b_);
  }

 private:
  static constexpr double steepest = 3.0;  ///< of the corner of a cube
  double a_, b_;
};

}  // namespace tripoint::carried_liquid
