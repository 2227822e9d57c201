// SPDX-License-Identifier: BSD-3-Clause
// A corrected gradient at a surface: what it sees of linear and of curved displacements.
#include "sph/surface_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "sph/kernels.hpp"
#include "sph/solid.hpp"

namespace tripoint::solid {
namespace {

/// Partners of a particle at the origin of the cubic lattice of spacing 1, where `there` says so.
std::vector<GradientPoint> lattice(const std::function<bool(const Vec3&)>& there, double jitter = 0.0) {
  const ElasticityKernel kernel(2.12);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  std::vector<GradientPoint> points;
  for (int z = -2; z <= 2; ++z)
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) {
        const Vec3 place{double(x), double(y), double(z)},
            moved = place + Vec3{shift(random), shift(random), shift(random)};
        const double r = norm(moved);
        if ((x != 0 || y != 0 || z != 0) && there(place) && r < 2.12)
          points.push_back({moved, -kernel.derivative(r) / r});
      }
  return points;
}

bool everywhere(const Vec3&) { return true; }
bool below(const Vec3& r) { return r.y <= 0.0; }
bool in_an_edge(const Vec3& r) { return r.y <= 0.0 && r.z <= 0.0; }
bool in_a_corner(const Vec3& r) { return r.x <= 0.0 && r.y <= 0.0 && r.z <= 0.0; }

Symmetric moment_of(const std::vector<GradientPoint>& points) {
  Symmetric M;
  for (const GradientPoint& p : points) M = M + p.weight * square(p.x);
  return M;
}

/// The gradient of a displacement at the origin, where it is zero.
Vec3 gradient_of(const std::vector<GradientPoint>& points, bool corrected,
                 const std::function<double(const Vec3&)>& u) {
  const Symmetric A = shape_inverse(moment_of(points)).inverse;
  const std::vector<Vec3> c = curvature_correction(points, A);
  Vec3 sum;
  for (std::size_t n = 0; n < points.size(); ++n)
    sum += u(points[n].x) * (points[n].weight * (A * points[n].x) + (corrected ? c[n] : Vec3{}));
  return sum;
}

TEST(SurfaceGradient, IsLookedForWhereNoPartnerLiesOutward) {
  EXPECT_FALSE(at_surface(lattice(everywhere)));
  EXPECT_FALSE(at_surface(lattice([](const Vec3& r) { return r.y <= 1.0; })));  // the second layer
  EXPECT_FALSE(at_surface(lattice([](const Vec3& r) { return std::abs(r.y) <= 1.0; })));
  for (const auto& there : {below, in_an_edge, in_a_corner}) {
    EXPECT_TRUE(at_surface(lattice(there)));
    EXPECT_TRUE(at_surface(lattice(there, 0.2)));
  }
  EXPECT_FALSE(at_surface(lattice(everywhere, 0.2)));
  EXPECT_FALSE(at_surface({}));
}

TEST(SurfaceGradient, SeesALinearDisplacementAsBefore) {
  for (const auto& there : {below, in_an_edge, in_a_corner}) {
    for (const double jitter : {0.0, 0.2}) {
      const Vec3 g = gradient_of(lattice(there, jitter), true,
                                 [](const Vec3& r) { return 0.3 * r.x - 0.7 * r.y + 1.1 * r.z; });
      EXPECT_LT(norm(g - Vec3{0.3, -0.7, 1.1}), 1e-14);  // round-off of some 30 terms
    }
  }
}

TEST(SurfaceGradient, IsBlindToTheCurvaturesOfABentBar) {
  const std::vector<GradientPoint> points = lattice(below);
  // What bends stretches along x in proportion to y
  const auto along = [](const Vec3& r) { return r.x * r.y; };
  // And moves across, anticlastic
  const auto across = [](const Vec3& r) { return 0.5 * (r.x * r.x - 0.3 * r.z * r.z); };
  EXPECT_LT(norm(gradient_of(points, true, along)), 1e-14);
  EXPECT_LT(norm(gradient_of(points, true, [](const Vec3& r) { return r.y * r.z; })), 1e-14);
  // Strain is that of 0.3 spacings further in
  EXPECT_NEAR(gradient_of(points, false, along).x, -0.2956, 0.0001);
  EXPECT_GT(norm(gradient_of(points, false, across)), 0.15);
  EXPECT_LT(norm(gradient_of(points, true, across)), 0.25 * norm(gradient_of(points, false, across)));
}

TEST(SurfaceGradient, TurnsWithTheBody) {
  const Quaternion q = from_rotation_vector({0.4, -1.1, 0.7});
  const std::vector<GradientPoint> points = lattice(in_an_edge, 0.1);
  std::vector<GradientPoint> turned = points;
  for (GradientPoint& p : turned) p.x = rotate(q, p.x);
  const std::vector<Vec3> c = curvature_correction(points, shape_inverse(moment_of(points)).inverse),
                          d = curvature_correction(turned, shape_inverse(moment_of(turned)).inverse);
  for (std::size_t n = 0; n < c.size(); ++n) EXPECT_LT(norm(rotate(q, c[n]) - d[n]), 1e-13);
}

TEST(SurfaceGradient, GrowsLittleWhateverTheClusterIsLike) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  const ElasticityKernel kernel(2.12);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<GradientPoint> points;
    while (points.size() < 4 + static_cast<std::size_t>(trial % 10)) {
      const Vec3 x{uniform(random), uniform(random), uniform(random)};
      const bool free =
          std::ranges::none_of(points, [&](const GradientPoint& p) { return norm(p.x - x) < 0.6; });
      if (norm(x) > 0.7 && norm(x) < 2.0 && free)
        points.push_back({x, -kernel.derivative(norm(x)) / norm(x)});
    }
    const ShapeInverse shape = shape_inverse(moment_of(points));
    if (shape.rank != 3) continue;
    const std::vector<Vec3> c = curvature_correction(points, shape.inverse);
    double first = 0.0, second = 0.0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Vec3 d = points[n].weight * (shape.inverse * points[n].x);
      first += dot(d, d);
      second += dot(d + c[n], d + c[n]);
    }
    EXPECT_LT(second, 6.0 * first);  // without the cut it is more than a thousand
  }
}

}  // namespace
}  // namespace tripoint::solid
