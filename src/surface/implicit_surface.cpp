// SPDX-License-Identifier: BSD-3-Clause
#include "surface/implicit_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "surface/local_mean.hpp"

namespace tripoint {
namespace {

// Finer cells look at fewer particles in vain, and cost more to gather
constexpr double cells_per_radius = 2.0;

const SurfaceOptions& checked(const SurfaceOptions& o) {
  if (!(o.influence_radius > 0.0)) throw InputError("the influence radius of a surface is a positive length");
  if (!(o.distance > 0.0))
    throw InputError("the distance of a surface from its particles is a positive length");
  if (!(o.limits.t_low < o.limits.t_high)) throw InputError("t_low of (26) lies below t_high");
  return o;
}

}  // namespace

ImplicitSurface::ImplicitSurface(std::span<const Vec3> centres, const SurfaceOptions& options)
    : options_(checked(options)),
      cells_(centres, options_.influence_radius / cells_per_radius),
      origin_(bounds().low),
      near_(centres.size()) {
  // Cells that a ball of radius ir around a particle's cell may touch.
  const double ir = options_.influence_radius;
  for (const std::uint64_t key : cells_.occupied()) {
    const Box box = grown(cells_.box_of(CellTable::cell(key)), ir);
    const auto along = [&](const Vec3& r, std::size_t a) {
      return static_cast<std::int32_t>(std::floor((r[a] - origin_[a]) / ir));
    };
    for (int i = along(box.low, 0); i <= along(box.high, 0); ++i)
      for (int j = along(box.low, 1); j <= along(box.high, 1); ++j)
        for (int k = along(box.low, 2); k <= along(box.high, 2); ++k) {
          const std::uint64_t near = CellTable::key({i, j, k});
          if (near_.insert(near, 0)) near_keys_.push_back(near);
        }
  }
  std::ranges::sort(near_keys_);
}

std::optional<Box> ImplicitSurface::empty_box(const Vec3& r) const noexcept {
  const double ir = options_.influence_radius;
  const auto along = [&](std::size_t a) {
    return static_cast<std::int32_t>(std::floor(std::clamp((r[a] - origin_[a]) / ir, -1e6, 1e6)));
  };
  const CellIndex c{along(0), along(1), along(2)};
  if (near_.find(CellTable::key(c)) != CellTable::none) return {};
  const Vec3 low =
      origin_ + ir * Vec3{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  return Box{low, low + Vec3{ir, ir, ir}};
}

SurfaceValue SurfaceProbe::value(const Vec3& r) {
  const SurfaceOptions& o = surface_->options();
  const LocalMean mean = local_mean(cache_.around(r), r, o.influence_radius);
  SurfaceValue v;
  v.near = mean.weight > 0.0;
  if (!v.near) {
    v.phi = o.influence_radius;
    return v;
  }
  if (o.detector) {
    v.eigenvalue = largest_eigenvalue(mean.gradient);
    v.factor = detector_factor(v.eigenvalue, o.limits);
  }
  v.phi = norm(mean.offset) - o.distance * v.factor;
  return v;
}

Vec3 SurfaceProbe::gradient(const Vec3& r) {
  const double d = 0.02 * surface_->options().influence_radius;
  Vec3 g;
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 ahead = r, behind = r;
    ahead[a] += d;
    behind[a] -= d;
    g[a] = (phi(ahead) - phi(behind)) / (2.0 * d);
  }
  return g;
}

std::optional<double> SurfaceProbe::nearest(const Vec3& r) {
  const NearPoints& near = cache_.around(r);
  if (near.empty()) return {};
  double least = dot(Vec3{near.x[0], near.y[0], near.z[0]} - r, Vec3{near.x[0], near.y[0], near.z[0]} - r);
  for (std::size_t k = 1; k < near.row.size(); ++k) {
    const Vec3 d{near.x[k] - r.x, near.y[k] - r.y, near.z[k] - r.z};
    least = std::min(least, dot(d, d));
  }
  return std::sqrt(least);
}

}  // namespace tripoint
