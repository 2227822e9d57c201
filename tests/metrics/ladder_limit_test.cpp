// SPDX-License-Identifier: BSD-3-Clause
// The error that a ladder leaves at step 0, on errors that are known by hand.
#include "validation/metrics/ladder_limit.hpp"
#include "core/errors.hpp"

#include "validation/metrics/roache.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "validation/metrics/roache.hpp"

namespace tripoint {
namespace {

const std::vector<double> halves{0.01, 0.005, 0.0025, 0.00125};

std::vector<double> errors(double (*law)(double), const std::vector<double>& steps = halves) {
  std::vector<double> list;
  for (const double h : steps) list.push_back(law(h));
  return list;
}

bool agrees_with_truth(const LadderLimit& l) { return std::abs(l.value) <= 2.0 * l.uncertainty + 1e-12; }

TEST(LadderLimit, OfASchemeIsTheTruthWhateverItsOrder) {
  for (const auto law : {+[](double h) { return 60.0 * h; }, +[](double h) { return 400.0 * h * h; },
                         +[](double h) { return 60.0 * h - 900.0 * h * h; },
                         +[](double h) { return 1.0 - std::exp(-90.0 * h); },
                         +[](double h) { return 4e3 * std::pow(h, 4); }}) {
    const auto l = ladder_limit(halves, errors(law), {});
    EXPECT_TRUE(agrees_with_truth(l)) << l.value << " " << l.uncertainty;
    EXPECT_LT(std::abs(l.value) + 2.0 * l.uncertainty, 0.05 * law(halves.front())) << law(halves.front());
  }
}

TEST(LadderLimit, OfAWrongConstantIsWhatTheConstantLeaves) {
  // One per cent of an inertia: all that the errors share.
  const auto flat = ladder_limit(halves, {0.0376231689, 0.0376231639, 0.0376231636, 0.0376231636}, {});
  EXPECT_NEAR(flat.value, 0.03762316, 1e-8);
  EXPECT_LT(flat.uncertainty, 1e-8);
  // The same beneath the error of a scheme of first order, which is sixteen times as large.
  const auto hidden =
      ladder_limit(halves, errors([](double h) { return 0.0376 + 0.65 * (1.0 - std::exp(-50.0 * h)); }), {});
  EXPECT_NEAR(hidden.value, 0.0376, 2.0 * hidden.uncertainty);
  EXPECT_LT(hidden.uncertainty, 0.005);
}

TEST(LadderLimit, SeesThroughAChangeOfSign) {
  // g one per cent too small: the lag of semi-implicit Euler, 4.905 h, passes through the error of the
  // constant, -0.04905.
  const std::vector<double> steps{0.04, 0.02, 0.01, 0.005};
  const auto l =
      ladder_limit(steps, errors([](double h) { return std::abs(4.856 * h - 0.04905); }, steps), {});
  EXPECT_NEAR(std::abs(l.value), 0.04905, 1e-9);
  EXPECT_LT(l.uncertainty, 1e-9);
}

TEST(LadderLimit, IsNoSurerThanTheErrorsAndTheirFit) {
  const auto scattered = ladder_limit(halves, {0.5, 0.31, 0.22, 0.05}, {});
  EXPECT_GT(2.0 * scattered.uncertainty, std::abs(scattered.value));
  const auto sure = ladder_limit(halves, errors([](double h) { return 60.0 * h; }), {});
  const auto unsure =
      ladder_limit(halves, errors([](double h) { return 60.0 * h; }), {0.01, 0.01, 0.01, 0.01});
  EXPECT_LT(sure.uncertainty, 1e-12);
  EXPECT_GT(unsure.uncertainty, 0.01);
}

TEST(LadderLimit, OfTooFewLevelsIsNotKnown) {
  EXPECT_TRUE(std::isnan(ladder_limit({0.1, 0.05}, {0.2, 0.1}, {}).value));
  EXPECT_TRUE(std::isnan(ladder_limit(halves, {0.5, std::nan(""), 0.2, 0.1}, {}).value));
  EXPECT_NEAR(ladder_limit({0.04, 0.02, 0.01}, {0.4, 0.2, 0.1}, {}).value, 0.0, 1e-12);
}

}  // namespace
TEST(RoacheIndex, FindsOrderAndLimitOfAPowerLawOnUnequalRatios) {
  const std::vector<double> h{0.4, 0.25, 0.1};
  std::vector<double> f;
  for (const double one : h) f.push_back(2.0 - 3.0 * std::pow(one, 1.7));
  const RoacheIndex r = roache_index(h, f);
  EXPECT_TRUE(r.monotone);
  EXPECT_NEAR(r.order, 1.7, 1e-9);  // to the bracket of the root
  EXPECT_NEAR(r.limit, 2.0, 1e-9);
  EXPECT_NEAR(r.index, 1.25 * 3.0 * std::pow(0.1, 1.7), 1e-9);
}

TEST(RoacheIndex, ClaimsNoOrderOfValuesThatGoUpAndDown) {
  const RoacheIndex r = roache_index({0.4, 0.2, 0.1}, {1.0, 1.2, 1.1});
  EXPECT_FALSE(r.monotone);
  EXPECT_DOUBLE_EQ(r.index, 3.0 * (1.2 - 1.0));  // three times the largest change
  EXPECT_THROW((void)roache_index({0.2, 0.1}, {1.0, 1.2}), InputError);
}

}  // namespace tripoint
