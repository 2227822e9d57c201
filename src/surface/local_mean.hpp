// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/matrix3.hpp"
#include "core/vec3.hpp"
#include "surface/point_cells.hpp"

namespace tripoint {

/// Weighted mean rbar(r) of the places of the particles around r, (24), seen from r.
/// The weight is the density kernel (poly6) over its value at the centre, (1 - s^2)^3 with s = |r - r_j|/ir:
/// constants cancel in (24).
struct LocalMean {
  /// Sum of the weights [1]; 0 where no particle is within ir, and then the rest has no meaning
  double weight = 0.0;
  Vec3 offset;       ///< rbar(r) - r [m]
  Matrix3 gradient;  ///< d rbar_i/d r_k [1], not symmetric in general: rows i, columns k
};

/// @param points all those within ir of r, and any others   @param ir influence radius [m]
/// Four lanes on every machine, so that the bits are the same on all of them.
/// Compared with plain sums and with differences of rbar: tests/surface/local_mean_test.cpp.
[[nodiscard]] LocalMean local_mean(const NearPoints& points, const Vec3& r, double ir) noexcept;

}  // namespace tripoint
