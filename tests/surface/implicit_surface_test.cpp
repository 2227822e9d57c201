// SPDX-License-Identifier: BSD-3-Clause
// The surface function where its value is known, and what the factor f of (25) is there for.
#include "surface/implicit_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/quaternion.hpp"
#include "surface/shapes.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.01;

SurfaceOptions options(bool detector = true) {
  SurfaceOptions o = SurfaceOptions::for_spacing(dx);
  o.detector = detector;
  return o;
}

/// Distance from `from` along a unit vector at which phi becomes positive, by halving.
double leaves(SurfaceProbe& probe, const Vec3& from, const Vec3& along, double most) {
  double in = 0.0, out = most;
  for (int n = 0; n < 50; ++n)
    (probe.phi(from + 0.5 * (in + out) * along) < 0.0 ? in : out) = 0.5 * (in + out);
  return in;
}

TEST(ImplicitSurface, OfOneParticleIsABallOfTheRadiusR) {
  const ImplicitSurface surface(std::vector<Vec3>{{0.3, 0.2, 0.1}}, options());
  SurfaceProbe probe(surface);
  for (const double share : {0.2, 0.9, 1.3, 3.0}) {
    const double r = share * options().distance;
    EXPECT_NEAR(probe.phi({0.3 + r, 0.2, 0.1}), r - options().distance, 1e-15);
  }
  EXPECT_EQ(probe.value({0.3, 0.2, 0.1}).factor, 1.0);  // rbar does not move
  EXPECT_FALSE(probe.value({0.3, 0.2, 0.1 + 1.01 * options().influence_radius}).near);
}

/// A half space of particles, many to the influence radius: R/ir that puts phi = 0 at its face. For poly6 the
/// mean of half a ball lies 63/256 of its radius from the face, and f there is that of EV = 1.
TEST(ImplicitSurface, OfAFlatFaceLiesWhereTheContinuumSays) {
  std::vector<Vec3> places;
  constexpr int n = 14, depth = 14;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = 0; k < depth; ++k)
        places.push_back(dx * Vec3{static_cast<double>(i), static_cast<double>(j), -k - 0.5});
  SurfaceOptions o;
  o.influence_radius = 12.0 * dx;
  o.distance = 63.0 / 256.0 / detector_factor(1.0) * o.influence_radius;
  const ImplicitSurface surface(places, o);
  SurfaceProbe probe(surface);
  const SurfaceValue at_face = probe.value({0.0, 0.0, 0.0});
  // The lattice: (dx/ir)^2 = 7e-3, of which a fifth
  EXPECT_NEAR(at_face.phi / o.influence_radius, 0.0, 1.5e-3);
  EXPECT_NEAR(at_face.eigenvalue, 1.0, 5e-3);  // along the face rbar moves as r does
}

TEST(ImplicitSurface, HasTheFlatFaceOfALatticeHalfASpacingOutsideOfIt) {
  std::vector<Vec3> places;
  for (int i = -5; i <= 5; ++i)
    for (int j = -5; j <= 5; ++j)
      for (int k = 0; k < 6; ++k)
        places.push_back(dx * Vec3{static_cast<double>(i), static_cast<double>(j), -k - 0.5});
  const ImplicitSurface surface(places, options());
  SurfaceProbe probe(surface);
  for (const Vec3& at : {Vec3{0, 0, -dx}, Vec3{0.5 * dx, 0, -dx}, Vec3{0.3 * dx, 0.4 * dx, -dx}})
    EXPECT_NEAR(leaves(probe, at, {0, 0, 1}, 3 * dx) - dx, 0.0, 0.06 * dx);
}

TEST(ImplicitSurface, HasTheGradientOfItsDifferences) {
  const auto body = shapes::ball(6 * dx);
  const ImplicitSurface surface(shapes::lattice(body, dx, {0.5, 0.5, 0.5}), options());
  SurfaceProbe probe(surface);
  const Vec3 r = 6 * dx * Vec3{0.6, 0.64, 0.48}, g = probe.gradient(r);
  EXPECT_NEAR(norm(g), 0.6, 0.15);  // 1 - 0.39 for a flat face of the continuum
  EXPECT_GT(dot(g, r) / norm(g) / norm(r), 0.95);
  const Vec3 along{0.36, 0.48, 0.8};
  const double d = 1e-3 * dx;
  EXPECT_NEAR(dot(g, along), (probe.phi(r + d * along) - probe.phi(r - d * along)) / (2 * d), 0.01);
}

TEST(ImplicitSurface, TurnsWithItsParticles) {
  const auto body = shapes::torus(6 * dx, 3 * dx);
  const auto places = shapes::lattice(body, dx, {0.1, 0.2, 0.3});
  const Quaternion q = from_rotation_vector({0.4, -1.1, 0.7});
  const Vec3 shift{1.5, -0.7, 0.2};
  std::vector<Vec3> turned;
  for (const Vec3& r : places) turned.push_back(rotate(q, r) + shift);
  const ImplicitSurface before(places, options()), after(turned, options());
  SurfaceProbe one(before), other(after);
  int near = 0;
  for (const Vec3& r : body.surface) {
    const Vec3 at = 1.05 * r;
    if (!one.value(at).near) continue;
    ++near;
    EXPECT_NEAR(one.phi(at), other.phi(rotate(q, at) + shift), 1e-9 * dx);  // round-off of places of 1 m
  }
  EXPECT_GT(near, 1000);
}

/// Two balls, their surfaces a gap apart. The mean of what is near then jumps from one to the other between
/// them, and (22) has a film there.
struct Between {
  double least = 1.0;  ///< of phi on the plane between them, within a ball's radius of the axis [spacings]
  explicit Between(double gap, bool detector) {
    const auto body = shapes::ball(5 * dx);
    std::vector<Vec3> places;
    for (const Vec3& r : shapes::lattice(body, dx, {0.5, 0.5, 0.5})) {
      places.push_back(r - Vec3{0, 0, 5 * dx + 0.5 * gap});
      places.push_back(r + Vec3{0, 0, 5 * dx + 0.5 * gap});
    }
    const ImplicitSurface surface(places, options(detector));
    SurfaceProbe probe(surface);
    for (double x = 0.0; x < 5 * dx; x += 0.1 * dx)
      least = std::min(least, probe.phi({x, 0.13 * x, 0.0}) / dx);
  }
};

TEST(Detector, KeepsTwoNearBallsApartWhereTheUncorrectedSurfaceJoinsThem) {
  for (const double gap : {1.5, 2.0, 2.5}) {
    EXPECT_LT(Between(gap * dx, false).least, -0.1)
        << "without f a film lies between balls " << gap << " spacings apart";
    EXPECT_GE(Between(gap * dx, true).least, 0.0)
        << "with f they are two, " << gap << " spacings apart";  // 0 where f is 0 and rbar is r: a point
  }
  EXPECT_GT(Between(6.0 * dx, false).least, 0.5) << "beyond the influence radius nothing is near both";
}

/// In the corner of an L the mean lies outside of it: the surface of (22) fills the corner.
TEST(Detector, FillsAConcaveCornerLess) {
  std::vector<Vec3> places;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 16; ++k)
        if (i < 8 || k < 8) places.push_back(dx * Vec3{i + 0.5, j + 0.5, k + 0.5});
  const Vec3 corner{8 * dx, 4 * dx, 8 * dx}, out{std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  const ImplicitSurface with(places, options(true)), without(places, options(false));
  SurfaceProbe one(with), other(without);
  const double filled = leaves(one, corner - dx * out, out, 4 * dx) - dx,
               filled_before = leaves(other, corner - dx * out, out, 4 * dx) - dx;
  EXPECT_LT(filled, filled_before - 0.05 * dx);
  EXPECT_GT(filled, 0.0);
}

TEST(ImplicitSurface, RefusesLengthsThatAreNone) {
  SurfaceOptions o;
  EXPECT_THROW(ImplicitSurface(std::vector<Vec3>{{0, 0, 0}}, o), InputError);
  o = options();
  o.distance = -1.0;
  EXPECT_THROW(ImplicitSurface(std::vector<Vec3>{{0, 0, 0}}, o), InputError);
  o = options();
  o.limits = {2.0, 0.4};
  EXPECT_THROW(ImplicitSurface(std::vector<Vec3>{{0, 0, 0}}, o), InputError);
}

}  // namespace
}  // namespace tripoint
