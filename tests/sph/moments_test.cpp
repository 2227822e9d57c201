// SPDX-License-Identifier: BSD-3-Clause
#include "sph/moments.hpp"

#include <gtest/gtest.h>

namespace tripoint {
namespace {

constexpr double round_off = 1e-14;

void expect_near(const Symmetric& a, const Symmetric& b, double tolerance) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.zz, b.zz, tolerance);
  EXPECT_NEAR(a.yz, b.yz, tolerance);
  EXPECT_NEAR(a.xz, b.xz, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
}

TEST(PseudoInverse, IsTheInverseOfARegularMatrix) {
  // [[2,1,0],[1,2,0],[0,0,4]]^-1 = [[2,-1,0],[-1,2,0],[0,0,0.75]]/3
  expect_near(pseudo_inverse({2.0, 2.0, 4.0, 0.0, 0.0, 1.0}, 0.05),
              {2.0 / 3.0, 2.0 / 3.0, 0.25, 0.0, 0.0, -1.0 / 3.0}, round_off);
}

TEST(PseudoInverse, OfAFullMatrixTimesItIsOne) {
  const Symmetric m{1.1, 0.9, 1.0, 0.05, -0.1, 0.07}, a = pseudo_inverse(m, 0.05);
  for (const Vec3& e : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}})
    EXPECT_NEAR(norm(m * (a * e) - e), 0.0, round_off);
}

TEST(PseudoInverse, LeavesOutDirectionsBelowTheCut) {
  expect_near(pseudo_inverse({1.0, 0.049, 0.0, 0.0, 0.0, 0.0}, 0.05), {1.0, 0.0, 0.0, 0.0, 0.0, 0.0},
              round_off);
  expect_near(pseudo_inverse({1.0, 0.051, 0.0, 0.0, 0.0, 0.0}, 0.05), {1.0, 1.0 / 0.051, 0.0, 0.0, 0.0, 0.0},
              100 * round_off);
}

TEST(PseudoInverse, OfALineIsAlongTheLine) {
  // M = 3 e e^T with e = (1,1,0)/sqrt 2: the pseudo-inverse is e e^T/3
  expect_near(pseudo_inverse({1.5, 1.5, 0.0, 0.0, 0.0, 1.5}, 0.05),
              {1.0 / 6.0, 1.0 / 6.0, 0.0, 0.0, 0.0, 1.0 / 6.0}, round_off);
}

TEST(PseudoInverse, OfZeroIsZero) { expect_near(pseudo_inverse({}, 0.05), {}, 0.0); }

}  // namespace
}  // namespace tripoint
