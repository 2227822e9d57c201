// SPDX-License-Identifier: BSD-3-Clause
#include "surface/local_mean.hpp"

#include "core/machine.hpp"
#include "surface/mean_sums.hpp"

namespace tripoint {

template <>
MeanSumsFunction mean_sums_for<Avx2>();

LocalMean local_mean(const NearPoints& points, const Vec3& r, double ir) noexcept {
  static const MeanSumsFunction sums_of = machine_has_avx2() ? mean_sums_for<Avx2>() : &mean_sums<Any>;
  const MeanSums s =
      sums_of({points.x.data(), points.y.data(), points.z.data(), points.x.size()}, r, 1.0 / ir);
  LocalMean m;
  m.weight = s.w;
  if (!(s.w > 0.0)) return m;
  const Vec3 mean = s.wy / s.w;  // of y
  m.offset = ir * mean;
  // d/dr of t^3 is 6 t^2 y/ir, so that d rbar_i/d r_k = 6/sum t^3 (sum t^2 y_i y_k - mean_i sum t^2 y_k).
  m.gradient = (6.0 / s.w) * (full(s.uyy) - outer(mean, s.uy));
  return m;
}

}  // namespace tripoint
