// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tripoint {
namespace {

constexpr Vec3 I{0.1 / 2.4, 0.095, 0.335 / 3.0};  ///< of the block of 4 x 6 x 10 particles [kg m2]
constexpr double end = 10.0;                      ///< [s]

Vec3 start_L(const Vec3& w) { return {I.x * w.x, I.y * w.y, I.z * w.z}; }

/// Reference by fourth-order Runge-Kutta on the quaternion, at a step at which it is converged to 1e-12.
Quaternion reference(const Vec3& w0, double time) {
  const Vec3 L = start_L(w0);
  const auto rate = [&](const Quaternion& q) {
    const Vec3 w = angular_velocity(q, I, L);
    const Quaternion d = Quaternion{0.0, w.x, w.y, w.z} * q;
    return Quaternion{0.5 * d.w, 0.5 * d.x, 0.5 * d.y, 0.5 * d.z};
  };
  const auto plus = [](const Quaternion& q, double s, const Quaternion& d) {
    return Quaternion{q.w + s * d.w, q.x + s * d.x, q.y + s * d.y, q.z + s * d.z};
  };
  Quaternion q;
  const long n = std::lround(time / 2e-4);
  const double dt = time / static_cast<double>(n);
  for (long k = 0; k < n; ++k) {
    const auto a = rate(q), b = rate(plus(q, 0.5 * dt, a)), c = rate(plus(q, 0.5 * dt, b)),
               d = rate(plus(q, dt, c));
    q = plus(plus(plus(plus(q, dt / 6.0, a), dt / 3.0, b), dt / 3.0, c), dt / 6.0, d);
    q = normalised(q);
  }
  return q;
}

template <class Step>
double error(const Vec3& w0, double dt, Step step) {
  const Vec3 L = start_L(w0);
  Quaternion q;
  const long n = std::lround(end / dt);
  for (long k = 0; k < n; ++k) q = step(q, L, dt);
  return angle_between(q, reference(w0, end));
}
double error_of(const AxisOrder& order, double dt) {
  return error({1.0, 2.0, 3.0}, dt, [&](const Quaternion& q, const Vec3& L, double h) {
    return rotated_no_squish(q, I, L, h, order);
  });
}
double corrected_error(double dt) {
  return error({1.0, 2.0, 3.0}, dt,
               [](const Quaternion& q, const Vec3& L, double h) { return rotated_corrected(q, I, L, h); });
}
double paper_error(double dt) {
  return error({1.0, 2.0, 3.0}, dt,
               [](const Quaternion& q, const Vec3& L, double h) { return rotated_paper(q, I, L, h); });
}

TEST(NoSquishRotation, SpansTheKnownErrorsOverTheSixAxisOrders) {
  double least = 1.0, greatest = 0.0;
  for (const AxisOrder& order : {AxisOrder{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
    const double e = error_of(order, 1e-2);
    RecordProperty("order_" + std::to_string(order[0]) + std::to_string(order[1]) + std::to_string(order[2]),
                   std::to_string(e));
    std::printf("axes outer to inner %zu %zu %zu: %.3e rad\n", order[0], order[1], order[2], e);
    least = std::min(least, e);
    greatest = std::max(greatest, e);
  }
  EXPECT_NEAR(least, 7.8e-4, 0.3e-4);  // two digits, from an implementation apart
  EXPECT_NEAR(greatest, 1e-2, 1e-3);
}

TEST(CorrectedRotation, ErrsTenTimesLessThanTheBestOrderOfNoSquish) {
  EXPECT_LE(corrected_error(1e-2), 0.1 * error_of({0, 1, 2}, 1e-2));
  EXPECT_LE(error_of({0, 1, 2}, 1e-2), 2e-3);  // what the usual scheme has to reach
}

TEST(CorrectedRotation, IsOfSecondOrder) {
  for (const double dt : {4e-2, 2e-2, 1e-2}) {
    EXPECT_NEAR(std::log2(corrected_error(dt) / corrected_error(0.5 * dt)), 2.0, 0.05);
    EXPECT_NEAR(std::log2(error_of({0, 1, 2}, dt) / error_of({0, 1, 2}, 0.5 * dt)), 2.0, 0.05);
  }
}

TEST(CorrectedRotation, IsExactForABodyWithEqualMoments) {
  const Vec3 w{1.87, 3.74, 5.61}, cube{0.1, 0.1, 0.1};
  const Quaternion one_step = rotated_corrected({}, cube, 0.1 * w, 0.3);
  EXPECT_NEAR(angle_between(one_step, from_rotation_vector(0.3 * w)), 0.0, 1e-15);
  // A symmetric top: q = exp(t L/I_t) exp(t (1/I_a - 1/I_t) L_a a), whichever of its moments is the single
  // one.
  for (const Vec3& top : {Vec3{0.025, 0.065, 0.065}, Vec3{0.065, 0.065, 0.1}}) {
    const std::size_t a = top.x < top.y ? 0 : 2;
    const Vec3 L{0.3, -0.2, 0.5};
    Vec3 spin;
    spin[a] = L[a] * (1.0 / top[a] - 1.0 / top.y);
    Quaternion q;
    for (int k = 0; k < 10; ++k) q = rotated_corrected(q, top, L, 0.1);
    EXPECT_NEAR(angle_between(q, from_rotation_vector(L / top.y) * from_rotation_vector(spin)), 0.0, 1e-14);
  }
}

TEST(PaperRotation, IsOfFirstOrderAndOffByWhatIsKnown) {
  EXPECT_NEAR(paper_error(1e-3), 0.11, 0.005);
  EXPECT_NEAR(std::log2(paper_error(5e-4) / paper_error(2.5e-4)), 1.0, 0.1);
}

TEST(CorrectedRotation, KeepsItsEnergyOverALongSpin) {
  const Vec3 L = start_L({1.0, 2.0, 3.0});
  Quaternion q;
  const double before = rotation_energy(q, I, L);
  double worst = 0.0;
  for (int k = 0; k < 100000; ++k) {
    q = rotated_corrected(q, I, L, 1e-2);
    worst = std::max(worst, std::abs(rotation_energy(q, I, L) / before - 1.0));
  }
  EXPECT_LT(worst, 1e-4);
  EXPECT_GT(worst, 1e-6) << "a second-order scheme cannot be that good: is it turning at all?";
}

TEST(Rotation, AboutATruncatedAxisStandsStill) {
  const Vec3 line = truncated({1e-20, 1.0, 1.0}, 1.0, 0.1);
  EXPECT_EQ(line.x, 0.0);
  EXPECT_EQ(line.y, 1.0);
  const Vec3 w = angular_velocity({}, line, {5.0, 1.0, 0.0});
  EXPECT_EQ(w, (Vec3{0.0, 1.0, 0.0}));
  EXPECT_EQ(rotation_energy({}, line, {5.0, 1.0, 0.0}), 0.5);
}

}  // namespace
}  // namespace tripoint
