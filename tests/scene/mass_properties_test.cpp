// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "sampling/sample.hpp"

namespace tripoint {
namespace {

std::vector<Vec3> lattice(int nx, int ny, int nz, double dx) {
  std::vector<Vec3> r;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) r.push_back({(i + 0.5) * dx, (j + 0.5) * dx, (k + 0.5) * dx});
  return r;
}

MassProperties of(const std::vector<Vec3>& r, double m = 1.0) {
  return mass_properties(r, std::vector<double>(r.size(), m));
}

std::vector<Vec3> turned(std::vector<Vec3> r, const Quaternion& q, const Vec3& shift) {
  for (auto& p : r) p = rotate(q, p) + shift;
  return r;
}

/// Principal moments put back into the world frame must be the tensor.
double tensor_error(const std::vector<Vec3>& r, const MassProperties& p) {
  double worst = 0.0;
  for (const Vec3& w : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    Vec3 L;
    for (const auto& x : r) L += cross(x - p.centre, cross(w, x - p.centre));
    const Vec3 b = rotate_back(p.principal_axes, w);
    const Vec3 mine = rotate(p.principal_axes, {b.x * p.principal_inertia.x, b.y * p.principal_inertia.y,
                                                b.z * p.principal_inertia.z});
    worst = std::max(worst, norm(mine - L));
  }
  return worst;
}

TEST(MassProperties, OfALatticeCubeAreThoseOfTheCubeTimesOneMinusOneOverNSquared) {
  for (const int n : {2, 3, 4, 10, 20}) {
    const double dx = 0.4 / n;
    const auto p = of(lattice(n, n, n, dx), 1000.0 * dx * dx * dx);
    const double solid = p.mass * 0.4 * 0.4 / 6.0;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(p.principal_inertia[k] / solid, 1.0 - 1.0 / (n * n), 1e-12) << n;  // round-off of n^3 sums
    EXPECT_EQ(p.principal_axes, Quaternion{}) << "no rotation is invented for a cube";
  }
}

TEST(MassProperties, AscendInAProperFrameThatGivesTheTensorBack) {
  const auto block = lattice(6, 4, 2, 0.1);
  for (const auto& q : {Quaternion{}, normalised({0.3, -0.5, 0.7, 0.1}), normalised({-0.2, 0.9, 0.1, 0.4}),
                        normalised({1, 1, 1, 1})}) {
    const auto r = turned(block, q, {3.0, -2.0, 0.5});
    const auto p = of(r);
    EXPECT_LT(p.principal_inertia.x, p.principal_inertia.y);
    EXPECT_LT(p.principal_inertia.y, p.principal_inertia.z);
    EXPECT_NEAR(norm(p.principal_axes), 1.0, 1e-15);
    EXPECT_LT(tensor_error(r, p), 1e-11);  // round-off at a distance of 3 from the origin
  }
}

TEST(MassProperties, AreTheSameBitsWhereverTheLatticeStands) {
  // Exact in binary
  const auto a = of(lattice(4, 4, 8, 0.125)), b = of(turned(lattice(4, 4, 8, 0.125), {}, {16.0, -8.0, 4.0}));
  EXPECT_EQ(a.principal_inertia, b.principal_inertia);
  EXPECT_EQ(a.principal_axes, b.principal_axes);
}

TEST(MassProperties, OfPointsLinesAndPairsHaveZeroMomentsExactly) {
  const auto point = of({{1.0, 2.0, 3.0}});
  EXPECT_EQ(point.principal_inertia, (Vec3{0, 0, 0}));
  EXPECT_EQ(point.mass, 1.0);
  const auto q = normalised({0.3, -0.5, 0.7, 0.1});
  for (const int n : {2, 3, 7}) {
    const auto line = of(turned(lattice(n, 1, 1, 0.1), q, {5.0, 1.0, -2.0}));
    EXPECT_EQ(line.principal_inertia.x, 0.0);
    EXPECT_GT(line.principal_inertia.y, 0.0);
    EXPECT_NEAR(line.principal_inertia.y / line.principal_inertia.z, 1.0, 1e-12);
  }
}

TEST(MassProperties, OfASheetObeyThePerpendicularAxisTheorem) {
  const auto p = of(turned(lattice(5, 3, 1, 0.1), normalised({0.3, -0.5, 0.7, 0.1}), {}));
  EXPECT_NEAR(p.principal_inertia.z, p.principal_inertia.x + p.principal_inertia.y, 1e-14);
}

TEST(MassProperties, OfNothingAreZero) { EXPECT_EQ(of({}).mass, 0.0); }

/// A cube of 4 x 4 x 4 particles of 500 kg/m3.
std::vector<Vec3> cube_places() {
  std::vector<Vec3> places;
  for (int i = 0; i < 64; ++i)
    places.push_back({0.25 * (i % 4) - 0.375, 0.25 * (i / 4 % 4) - 0.375, 0.25 * (i / 16) - 0.375});
  return places;
}

Scene wooden() {
  Scene s;
  s.spacing = 0.25;
  s.materials.emplace_back();
  s.materials.back().density = 500.0;
  return s;
}

TEST(GivenMass, ParticlesCarryMassCentreAndTensorThatAreGiven) {
  Body b;
  b.name = "top";
  b.mass = 3.0;
  b.centre = Vec3{0.02, 0.0, -0.01};
  b.inertia = Vec3{0.42, 0.45, 0.54};
  const auto places = cube_places();
  const MassProperties p = mass_properties(places, particle_masses(wooden(), b, places));
  EXPECT_NEAR(p.mass, 3.0, 1e-12);  // round-off of ten equations
  EXPECT_NEAR(norm(p.centre - *b.centre), 0.0, 1e-12);
  EXPECT_NEAR(norm(p.principal_inertia - *b.inertia), 0.0, 1e-12);
}

TEST(GivenMass, ProductsTurnThePrincipalAxes) {
  Body b;
  b.inertia = Vec3{80.0, 80.0, 80.0};
  b.products = Vec3{5.0, 0.0, 0.0};
  const auto places = cube_places();
  const MassProperties p = mass_properties(places, particle_masses(wooden(), b, places));
  EXPECT_NEAR(p.principal_inertia.x, 75.0, 1e-9);
  EXPECT_NEAR(p.principal_inertia.z, 85.0, 1e-9);
}

TEST(GivenMass, AShapeOfOddSizeWeighsWhatItDoesAndNotWhatItsParticlesDo) {
  Body b;
  b.shape.kind = Shape::Kind::box;
  b.shape.min = {-0.45, -0.45, -0.45};
  b.shape.max = {0.45, 0.45, 0.45};
  b.shape_mass = true;
  const auto places = cube_places();
  const MassProperties p = mass_properties(places, particle_masses(wooden(), b, places));
  EXPECT_NEAR(p.mass, 500.0 * 0.729, 1e-9);
  EXPECT_NEAR(p.principal_inertia.x, p.mass * 0.81 / 6.0, 1e-9);  // M side^2/6
}

TEST(GivenMass, WhatParticlesCannotCarryIsRefusedByName) {
  Body b;
  b.name = "rod";
  b.inertia = Vec3{1e4, 1e4, 1e4};  // beyond its corners
  EXPECT_THROW((void)particle_masses(wooden(), b, cube_places()), InputError);
}

}  // namespace
}  // namespace tripoint
