// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "core/lanes.hpp"
#include "core/matrix3.hpp"
#include "core/vec3.hpp"

namespace tripoint {

/// The sums behind (24) and its gradient, y = (r_j - r)/ir, t = max(0, 1 - y^2): of t^3, t^3 y, t^2 y, t^2 y
/// y^T.
struct MeanSums {
  double w = 0.0;
  Vec3 wy, uy;
  Symmetric uyy;
};

/// Places of points, padded to whole vectors of four.
struct PlaceColumns {
  const double *x, *y, *z;  ///< [m]
  std::size_t size;         ///< with the padding
};

using MeanSumsFunction = MeanSums (*)(const PlaceColumns&, const Vec3& r, double per_ir);

/// Adds the four lanes in one order.
[[nodiscard]] inline double sum_of_lanes(Lanes<4>::Real v) noexcept { return (v[0] + v[1]) + (v[2] + v[3]); }

template <class ForUnit>
[[gnu::flatten]] MeanSums mean_sums(const PlaceColumns& places, const Vec3& r, double per_ir) {
  using V = Lanes<4>::Real;
  V w{}, wx{}, wy{}, wz{}, ux{}, uy{}, uz{}, uxx{}, uyy{}, uzz{}, uyz{}, uxz{}, uxy{};
  for (std::size_t k = 0; k < places.size; k += 4) {
    const V x = (load_lanes<4>(places.x + k) - r.x) * per_ir,
            y = (load_lanes<4>(places.y + k) - r.y) * per_ir,
            z = (load_lanes<4>(places.z + k) - r.z) * per_ir;
    const V inside = 1.0 - ((x * x + y * y) + z * z);
    const V t = where<V>(inside > 0.0, inside);
    const V u = t * t, w_j = u * t;
    const V u_x = u * x, u_y = u * y, u_z = u * z;
    w += w_j;
    wx += w_j * x;
    wy += w_j * y;
    wz += w_j * z;
    ux += u_x;
    uy += u_y;
    uz += u_z;
    uxx += u_x * x;
    uyy += u_y * y;
    uzz += u_z * z;
    uyz += u_y * z;
    uxz += u_x * z;
    uxy += u_x * y;
  }
  MeanSums s;
  s.w = sum_of_lanes(w);
  s.wy = {sum_of_lanes(wx), sum_of_lanes(wy), sum_of_lanes(wz)};
  s.uy = {sum_of_lanes(ux), sum_of_lanes(uy), sum_of_lanes(uz)};
  s.uyy = {sum_of_lanes(uxx), sum_of_lanes(uyy), sum_of_lanes(uzz),
           sum_of_lanes(uyz), sum_of_lanes(uxz), sum_of_lanes(uxy)};
  return s;
}

/// The sums as they are compiled for a vector unit: the same bits.
template <class ForUnit>
[[nodiscard]] MeanSumsFunction mean_sums_for();

}  // namespace tripoint
