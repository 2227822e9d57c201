// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "references/scenes.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

using Real = long double;
using State = std::array<Real, 7>;  // spin in the principal frame, quaternion principal to world

/// Euler's equations and the quaternion's rate: nothing in common with the elliptic solution.
State rate(const std::array<Real, 3>& I, const State& s) {
  const auto [w1, w2, w3, q0, q1, q2, q3] = s;
  return {(I[1] - I[2]) / I[0] * w2 * w3,    (I[2] - I[0]) / I[1] * w3 * w1,
          (I[0] - I[1]) / I[2] * w1 * w2,    (-q1 * w1 - q2 * w2 - q3 * w3) / 2,
          (q0 * w1 + q2 * w3 - q3 * w2) / 2, (q0 * w2 + q3 * w1 - q1 * w3) / 2,
          (q0 * w3 + q1 * w2 - q2 * w1) / 2};
}

State advanced(const State& s, const State& k, Real h) {
  State out = s;
  for (std::size_t i = 0; i < s.size(); ++i) out[i] += h * k[i];
  return out;
}

/// Classical Runge-Kutta in long double; at h = 2e-4 its error is under 1e-13 here (halving h changes nothing
/// above that).
State integrate(const std::array<Real, 3>& I, State s, Real end, int steps) {
  const Real h = end / steps;
  for (int n = 0; n < steps; ++n) {
    const State a = rate(I, s), b = rate(I, advanced(s, a, h / 2)), c = rate(I, advanced(s, b, h / 2)),
                d = rate(I, advanced(s, c, h));
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return s;
}

void expect_same_motion(const Vec3& inertia, const Quaternion& axes, const Vec3& spin, double end,
                        double tolerance) {
  const TorqueFree exact(inertia, axes, spin);
  const Vec3 w = rotate_back(axes, spin);
  const State start{w.x, w.y, w.z, axes.w, axes.x, axes.y, axes.z};
  const State last = integrate({inertia.x, inertia.y, inertia.z}, start, end, static_cast<int>(end / 2e-4));
  const Quaternion ode = normalised({double(last[3]), double(last[4]), double(last[5]), double(last[6])});
  EXPECT_LT(angle_between(exact.rotation(end), normalised(ode * conjugate(axes))), tolerance);
  const Vec3 ode_spin = rotate(ode, {double(last[0]), double(last[1]), double(last[2])});
  EXPECT_LT(norm(exact.angular_velocity(end) - ode_spin), tolerance * norm(spin));
}

const Vec3 block_inertia{1.0 / 24.0, 0.095, 0.67 / 6.0};

TEST(TorqueFree, AgreesWithLongDoubleRungeKuttaForTheBlock) {
  const Quaternion tilted = from_rotation_vector({0.3, -0.7, 1.1});
  for (const Vec3& spin : {Vec3{1, 2, 3}, Vec3{3, 0.2, 0.1}, Vec3{-1, 2, -3}, Vec3{0.5, -4, 0.4}})
    for (const Quaternion& axes : {Quaternion{}, tilted})
      expect_same_motion(block_inertia, axes, spin, 10.0, 1e-11);
}

TEST(TorqueFree, AgreesWithRungeKuttaForAxisymmetricAndNearlySymmetricBodies) {
  expect_same_motion({0.025, 0.065, 0.065}, {}, {6, 2, 4}, 10.0, 1e-11);
  expect_same_motion({0.065, 0.065, 0.025}, {}, {2, 4, 6}, 10.0, 1e-11);
  expect_same_motion({1.0, 2.0, 2.001}, {}, {0.3, 1.0, 0.2}, 20.0, 1e-11);
  expect_same_motion({1.0, 1.001, 2.0}, {}, {0.3, 1.0, 0.2}, 20.0, 1e-11);
  expect_same_motion({1.0, 2.0, 3.0}, {}, {1e-6, 1e-6, 1.0}, 20.0, 1e-11);
}

TEST(TorqueFree, PrecessesAsTheClosedFormOfASymmetricBody) {
  // q = exp(L t/It) exp(z (1 - Iz/It) wz t): two turns, one about L and one about the body's own axis.
  const double It = 0.065, Iz = 0.025, t = 1000.0;
  const Vec3 w{2, 4, 6};
  const Vec3 L{It * w.x, It * w.y, Iz * w.z};
  const Quaternion closed =
      from_rotation_vector((t / It) * L) * from_rotation_vector({0, 0, (1.0 - Iz / It) * w.z * t});
  // 1e4 rad at round-off 1e-15
  EXPECT_LT(angle_between(TorqueFree({It, It, Iz}, {}, w).rotation(t), closed), 1e-11);
}

TEST(TorqueFree, KeepsAngularMomentumAndEnergyAfterAThousandSeconds) {
  const Vec3 w{1, 2, 3};
  const TorqueFree exact(block_inertia, {}, w);
  const auto momentum_and_energy = [&](double t) {
    const Quaternion q = exact.rotation(t);
    const Vec3 body = rotate_back(q, exact.angular_velocity(t));
    const Vec3 L{block_inertia.x * body.x, block_inertia.y * body.y, block_inertia.z * body.z};
    return std::pair{rotate(q, L), 0.5 * dot(L, body)};
  };
  const auto [L0, E0] = momentum_and_energy(0.0);
  const auto [L1, E1] = momentum_and_energy(1000.0);
  EXPECT_LT(norm(L1 - L0) / norm(L0), 1e-13);
  EXPECT_NEAR(E1 / E0, 1.0, 1e-13);
  EXPECT_LT(angle_between(exact.rotation(0.0), {}), 1e-15);
}

TEST(TorqueFree, SpinsSteadilyAboutAPrincipalAxisAndForASphere) {
  EXPECT_TRUE(TorqueFree(block_inertia, {}, {0, 3, 0}).steady());
  EXPECT_TRUE(TorqueFree({1, 1, 1}, {}, {1, 2, 3}).steady());
  EXPECT_TRUE(TorqueFree({0, 1, 1}, {}, {0, 2, 3}).steady());  // a line of particles
  EXPECT_FALSE(TorqueFree(block_inertia, {}, {0.01, 5, 0.01}).steady());
  const TorqueFree sphere({1, 1, 1}, {}, {0, 0, 2});
  EXPECT_NEAR(sphere.rotation(0.5).z, std::sin(0.5), 1e-15);
}

TEST(TorqueFree, FlipsWhereTheSpinOfAnOdeChangesSign) {
  const Vec3 w{0.01, 5, 0.01};
  const TorqueFree exact(block_inertia, {}, w);
  const auto flips = exact.flips(20.0);
  ASSERT_EQ(flips.size(), 3U);
  // 4.46698263 s and 7.50785812 s: the rigid notes' long double Runge-Kutta, eight decimals.
  EXPECT_NEAR(flips[0], 4.46698263, 1e-8);
  EXPECT_NEAR(flips[1] - flips[0], 7.50785812, 1e-8);
  const auto middle = [&](Real t) {
    return integrate({block_inertia.x, block_inertia.y, block_inertia.z}, {w.x, w.y, w.z, 1, 0, 0, 0}, t,
                     40000)[1];
  };
  EXPECT_LT(std::abs(double(middle(flips[0]))), 1e-9);
  EXPECT_GT(double(middle(flips[0] - 1e-6) * -middle(flips[0] + 1e-6)), 0.0);
}

TEST(TorqueFree, CostsLittleEvenForManyOutputTimes) {
  const auto start = std::chrono::steady_clock::now();
  const auto setup = test::block({1, 2, 3}, 1000.0, 1000);
  const auto reference = make_reference(test::function("torque_free"), setup.job, setup.initial);
  double sum = 0.0;
  for (const double t : setup.job.times) sum += reference->at(t).bodies[0].orientation.w;
  EXPECT_TRUE(std::isfinite(sum));
  // 0.2 s alone on a core
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
}

}  // namespace
}  // namespace tripoint
