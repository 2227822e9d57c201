// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/surface_fill.hpp"

#include <cmath>

#include "sph/kernels.hpp"

namespace tripoint::carried_liquid {
namespace {

/// S and h |grad S|/S of a particle of the lattice with so many layers above it, over those inside.
struct Layer {
  double sum = 0.0, slope = 0.0;
};

Layer under_surface(double h, int above) {
  const WendlandC2 kernel(h);
  const int reach = static_cast<int>(h) + 1;
  double full = 0.0;
  Layer layer;
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z)), w = kernel.value(r);
        full += w;
        if (z > above) continue;
        layer.sum += w;
        layer.slope += kernel.derivative_over_r(r) * z;
      }
  layer.slope = h * std::abs(layer.slope) / layer.sum;
  layer.sum /= full;
  return layer;
}

}  // namespace

SurfaceFill::SurfaceFill(double support_ratio) {
  const Layer top = under_surface(support_ratio, 0), next = under_surface(support_ratio, 1);
  const double of_top = (1.0 - top.sum) / top.slope, of_next = (1.0 - next.sum) / next.slope;
  b_ = (of_top - of_next) / (top.slope - next.slope);
  a_ = of_top - b_ * top.slope;
}

}  // namespace tripoint::carried_liquid
