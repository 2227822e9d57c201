// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/surface_fill.hpp"

#include "sph/lattice.hpp"

namespace tripoint::carried_liquid {

SurfaceFill::SurfaceFill(double support_ratio, Dimensions d) {
  const LatticeLayer top = layer_under_surface(support_ratio, 0, d),
                     next = layer_under_surface(support_ratio, 1, d);
  const double of_top = (1.0 - top.sum) / top.slope, of_next = (1.0 - next.sum) / next.slope;
  b_ = (of_top - of_next) / (top.slope - next.slope);
  a_ = of_top - b_ * top.slope;
}

}  // namespace tripoint::carried_liquid
