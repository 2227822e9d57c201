// SPDX-License-Identifier: BSD-3-Clause
#include "scene/particle_masses.hpp"

#include <fmt/format.h>

#include <cmath>
#include <Eigen/Dense>

#include "core/errors.hpp"
#include "scene/geometry.hpp"
#include "scene/sample.hpp"
#include "scene/shape_distance.hpp"

namespace tripoint {
namespace {

constexpr int terms = 10;  ///< 1, x, y, z, xx, yy, zz, xy, xz, yz
using Terms = Eigen::Matrix<double, terms, 1>;

Terms terms_at(const Vec3& r) {
  Terms t;
  t << 1.0, r.x, r.y, r.z, r.x * r.x, r.y * r.y, r.z * r.z, r.x * r.y, r.x * r.z, r.y * r.z;
  return t;
}

/// Mass, centre and the tensor of inertia about it, of axes x, y, z.
struct Wanted {
  double mass;
  Vec3 centre;
  Eigen::Matrix3d inertia;
};

Eigen::Matrix3d tensor_of(const MassProperties& p) {
  const Quaternion& q = p.principal_axes;
  const Eigen::Matrix3d axes = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  const Eigen::Vector3d moments(p.principal_inertia.x, p.principal_inertia.y, p.principal_inertia.z);
  return axes * moments.asDiagonal() * axes.transpose();
}

/// What the particles weigh where nothing is given, or the shape does.
MassProperties before_given(const Scene& s, const Body& b, const MassProperties& own, double density) {
  if (!b.shape_mass) return own;
  const auto shape = mass_of_shape(b.shape, density, s.spacing, s.space());
  if (!shape || !(shape->mass > 0.0))
    throw InputError(
        b.place, fmt::format("body \"{}\": its shape has no mass of its own: leave out shape_mass", b.name));
  return *shape;
}

Wanted wanted_of(const Body& b, const MassProperties& from) {
  const double mass = b.mass.value_or(from.mass);
  Wanted w{mass, b.centre.value_or(from.centre), tensor_of(from) * (mass / from.mass)};
  if (!b.inertia) return w;
  w.inertia = Eigen::Vector3d(b.inertia->x, b.inertia->y, b.inertia->z).asDiagonal();
  w.inertia(0, 1) = w.inertia(1, 0) = b.products.x;
  w.inertia(0, 2) = w.inertia(2, 0) = b.products.y;
  w.inertia(1, 2) = w.inertia(2, 1) = b.products.z;
  return w;
}

/// Sums of the terms over the masses, places in spacings from an origin [kg].
Terms sums_of(const Wanted& w, const Vec3& origin, double spacing) {
  const Vec3 c = (w.centre - origin) / spacing;
  const Eigen::Matrix3d I = w.inertia / (spacing * spacing);
  const Eigen::Matrix3d second = 0.5 * I.trace() * Eigen::Matrix3d::Identity() - I;  // sum of m d d^T
  Terms t;
  t << w.mass, w.mass * c.x, w.mass * c.y, w.mass * c.z, second(0, 0) + w.mass * c.x * c.x,
      second(1, 1) + w.mass * c.y * c.y, second(2, 2) + w.mass * c.z * c.z, second(0, 1) + w.mass * c.x * c.y,
      second(0, 2) + w.mass * c.x * c.z, second(1, 2) + w.mass * c.y * c.z;
  return t;
}

}  // namespace

bool carries_given_mass(const Body& b) { return b.mass || b.centre || b.inertia || b.shape_mass; }

std::vector<double> particle_masses(const Scene& s, const Body& b, const std::vector<Vec3>& places) {
  const double spacing = s.spacing, density = s.material(b.material).density;
  std::vector<double> mass(places.size(), density * spacing * spacing * cell_depth(s));
  if (!carries_given_mass(b)) return mass;
  const MassProperties own = mass_properties(places, mass);
  const Wanted wanted = wanted_of(b, before_given(s, b, own, density));
  const auto at = [&](const Vec3& r) { return terms_at((r - own.centre) / spacing); };
  Eigen::Matrix<double, terms, terms> A = Eigen::Matrix<double, terms, terms>::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) A += mass[i] * at(places[i]) * at(places[i]).transpose();
  const Terms sums = sums_of(wanted, own.centre, spacing);
  const Terms factor = A.completeOrthogonalDecomposition().solve(sums);
  const Terms missed = A * factor - sums;
  bool carried = missed.norm() <= 1e-9 * sums.norm();
  for (std::size_t i = 0; i < places.size(); ++i) {
    mass[i] *= factor.dot(at(places[i]));
    carried = carried && mass[i] > 0.0;
  }
  if (!carried)
    throw InputError(b.place, fmt::format("body \"{}\": its {} particles cannot carry the mass, centre and "
                                          "moments that are given: refine scene.spacing, or give what its "
                                          "shape can have",
                                          b.name, places.size()));
  return mass;
}

}  // namespace tripoint
