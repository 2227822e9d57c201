// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "scene/geometry.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// Particle centres of one body: (k + 1/2) dx from an origin along each axis.
/// Periodic directions share the domain's lattice. Otherwise a body whose corner lies on the scene's lattice
/// (multiples of dx) shares that lattice, so that bodies which touch fit. Any other body has a lattice of its
/// own from its corner, or about its centre of symmetry.
struct Lattice {
  Vec3 origin;
  double spacing = 0.0;
  std::array<long, 3> first{}, count{};  ///< cells that the body's bounds may reach

  [[nodiscard]] Vec3 centre(long i, long j, long k) const {
    const auto at = [&](double o, long f, long n) {
      return o + (static_cast<double>(f + n) + 0.5) * spacing;
    };
    return {at(origin.x, first[0], i), at(origin.y, first[1], j), at(origin.z, first[2], k)};
  }
  /// Particles across the bounds along an axis.
  [[nodiscard]] long across(std::size_t axis) const { return count[axis]; }
};

/// @throws InputError when the body has no finite bounds, would need more than 1e8 cells, or a periodic
/// domain is no multiple of dx
[[nodiscard]] Lattice lattice_of(const Scene&, const Body&);

/// Centres of the particles that fill the body, x fastest; neither jittered nor wrapped. @throws InputError
/// when there is none
[[nodiscard]] std::vector<Vec3> fill(const Scene&, const Body&);

/// A place at most one width outside the domain, put back into it where a direction is periodic [m].
[[nodiscard]] Vec3 wrapped(const Scene&, Vec3 r);

}  // namespace tripoint
