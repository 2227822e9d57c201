// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/initial_state.hpp"

#include "core/not_a_number.hpp"
#include "validation/metrics/order.hpp"

namespace tripoint {
namespace {

using List = std::vector<double>;

List levels(double first, int count) {
  List h;
  for (int n = 0; n < count; ++n) h.push_back(first * std::pow(0.5, n));
  return h;
}
template <class F>
List errors(const List& h, F f) {
  List e;
  for (const double x : h) e.push_back(f(x));
  return e;
}

TEST(Order, FindsTheOrderOfAPowerLawWithItsInterval) {
  const auto h = levels(0.1, 5);
  const auto fit = fit_order(h, errors(h, [](double x) { return 3.0 * x * x; }), {}, 2.0);
  EXPECT_NEAR(fit.value, 2.0, 1e-12);
  EXPECT_NEAR(fit.coefficient, 3.0, 1e-10);
  EXPECT_EQ(fit.fit_class, FitClass::asymptotic);
  EXPECT_LE(fit.low, fit.value);
  EXPECT_GE(fit.high, fit.value);
}

TEST(Order, CoversTheTrueOrderInNinetyFiveOfAHundredNoisyStudies) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.05);
  const auto h = levels(0.1, 6);
  int covered = 0;
  const int studies = 2000;
  for (int n = 0; n < studies; ++n) {
    const auto fit =
        fit_order(h, errors(h, [&](double x) { return x * x * std::exp(noise(random)); }), {}, 2.0);
    if (fit.fit_class == FitClass::plateau) continue;  // the few where noise looks like a floor
    covered += fit.low <= 2.0 && 2.0 <= fit.high ? 1 : 0;
  }
  EXPECT_NEAR(covered / double(studies), 0.95, 0.03);  // binomial 3 sigma 0.015, and the dropped plateaus
}

TEST(Order, ReproducesTheIntervalOfTheKnownHeatStudy) {
  // 6.58e-2, 1.63e-2, 4.06e-3, 1.02e-3: order 2.006 +- 0.009 (validation notes; three digits of data).
  const auto fit =
      fit_order({1.0 / 20, 1.0 / 40, 1.0 / 80, 1.0 / 160}, {6.58e-2, 1.63e-2, 4.06e-3, 1.02e-3}, {}, 2.0);
  EXPECT_NEAR(fit.value, 2.004, 0.003);
  EXPECT_NEAR(fit.high - fit.value, 0.009, 0.012);
  EXPECT_EQ(fit.fit_class, FitClass::asymptotic);
}

TEST(Order, NamesAPlateauAndItsLevel) {
  const auto h = levels(0.1, 4);
  const auto fit = fit_order(h, errors(h, [](double x) { return -(0.0714 + 3.6 * x * x); }), {}, 2.0);
  EXPECT_EQ(fit.fit_class, FitClass::plateau);
  EXPECT_NEAR(fit.floor, -0.0714, 1e-6);
  // The printed heat operator at 10/20/40/80 a wavelength, three digits.
  EXPECT_EQ(fit_order({0.1, 0.05, 0.025, 0.0125}, {-0.108, -0.081, -0.074, -0.072}, {}, 2.0).fit_class,
            FitClass::plateau);
  // Errors that grow to a floor, and errors that change sign on their way to one.
  EXPECT_EQ(
      fit_order({1. / 20, 1. / 40, 1. / 80, 1. / 160}, {2.0e-2, 3.7e-2, 4.2e-2, 4.3e-2}, {}, 2.0).fit_class,
      FitClass::plateau);
  EXPECT_EQ(fit_order({0.1, 0.05, 0.025, 0.0125}, {-0.046, 0.007, 0.021, 0.025}, {}, 2.0).fit_class,
            FitClass::plateau);
}

TEST(Order, DoesNotHideDivergenceBehindAMagnitude) {
  const auto h = levels(0.1, 4);
  const auto fit = fit_order(h, errors(h, [](double x) { return 1e-3 / (x * x); }), {}, 2.0);
  EXPECT_NEAR(fit.value, -2.0, 1e-10);
  EXPECT_EQ(fit.fit_class, FitClass::diverging);
  EXPECT_EQ(fit_order(levels(0.1, 6), {1e-4, 6e-4, 5e-4, 4e-3, 3e-2, 2e-1}, {}, 2.0).fit_class,
            FitClass::diverging);  // not monotone, yet below 0 at 95 %
  EXPECT_EQ(fit_order(h, {1e-2, 1e-3, not_a_number, 1e-5}, {}, 2.0).fit_class, FitClass::diverging);
  EXPECT_TRUE(std::isnan(fit_order(h, {1e-2, 1e-3, not_a_number, 1e-5}, {}, 2.0).value));
}

TEST(Order, TellsTooFewNoiseRoundoffAndOscillation) {
  const auto h3 = levels(0.1, 3), h4 = levels(0.1, 4);
  EXPECT_EQ(fit_order(h3, {4e-2, 1e-2, 2.5e-3}, {}, 2.0).fit_class, FitClass::too_few);
  EXPECT_EQ(fit_order({0.1}, {1.0}, {}, 2.0).fit_class, FitClass::too_few);
  EXPECT_EQ(fit_order(h4, {4e-2, 1e-2, 2.5e-3, 6e-4}, {2e-3, 2e-3, 2e-3, 2e-3}, 2.0).fit_class,
            FitClass::noise_limited);
  EXPECT_EQ(fit_order(h4, {1e-15, 3e-15, 2e-15, 0.0}, {}, 2.0).fit_class, FitClass::roundoff);
  EXPECT_EQ(fit_order(h4, {1e-2, -5e-3, 4e-3, -1e-3}, {}, 2.0).fit_class, FitClass::oscillating);
  EXPECT_EQ(fit_order(h4, {1e-2, 0.0, 4e-3, 1e-3}, {}, 2.0).fit_class, FitClass::oscillating);
}

TEST(Order, DoesNotCallAnotherOrderAsymptotic) {
  const auto h = levels(0.1, 4);
  EXPECT_EQ(fit_order(h, errors(h, [](double x) { return x; }), {}, 2.0).fit_class, FitClass::preasymptotic);
  EXPECT_EQ(fit_order(h, errors(h, [](double x) { return std::pow(x, 3); }), {}, 2.0).fit_class,
            FitClass::preasymptotic);
  EXPECT_EQ(fit_order(h, errors(h, [](double x) { return x * x + 400 * std::pow(x, 4); }), {}, 2.0).fit_class,
            FitClass::preasymptotic);
}

TEST(Order, LooksAtTheLastTwoSlopesForWhetherItHasSettled) {
  const auto of_slopes = [](const List& slopes) {
    List e{1e-2};
    for (const double slope : slopes) e.push_back(e.back() * std::pow(0.5, slope));
    return fit_order(levels(0.1, static_cast<int>(e.size())), e, {}, 2.0).fit_class;
  };
  EXPECT_EQ(of_slopes({1.6, 2.0, 2.0}), FitClass::asymptotic);  // the coarsest level was too coarse
  EXPECT_EQ(of_slopes({2.0, 2.0, 1.6}), FitClass::preasymptotic);
}

TEST(GridConvergence, BoundsTheErrorOfASecondOrderSeries) {
  const auto h = levels(0.1, 4);
  const auto value = errors(h, [](double x) { return 5.0 + 2.0 * x * x; });
  const double error = value.back() - 5.0;
  // Fs = 1.25, k = 2
  EXPECT_NEAR(grid_convergence_uncertainty(h, value, 2.0), 0.5 * 1.25 * error, 1e-3 * error);
  const auto scattered = errors(h, [](double x) { return 5.0 + 2.0 * x * x + 0.05 * std::sin(1e4 * x); });
  EXPECT_GT(grid_convergence_uncertainty(h, scattered, 2.0), 0.01);
  EXPECT_NEAR(grid_convergence_uncertainty({0.1, 0.05}, {5.02, 5.005}, 2.0), 0.5 * 3.0 * 0.015 / 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(grid_convergence_uncertainty({0.1}, {1.0}, 2.0)));
  EXPECT_TRUE(std::isnan(grid_convergence_uncertainty(h, {1, not_a_number, 1, 1}, 2.0)));
}

TEST(GridConvergence, DoesNotTrustAnObservedOrderAboveTheFormalOne) {
  const auto h = levels(0.1, 4);
  const auto value = errors(h, [](double x) { return 5.0 + 2.0 * std::pow(x, 4); });
  EXPECT_GT(grid_convergence_uncertainty(h, value, 2.0), value.back() - 5.0);  // factor 3 at a fixed power
}

TEST(Verdict, HasThreeAnswersAndNotANumberFails) {
  EXPECT_EQ(judge_limit(0.8, 0.05, 1.0), Verdict::pass);
  EXPECT_EQ(judge_limit(1.2, 0.05, 1.0), Verdict::fail);
  EXPECT_EQ(judge_limit(0.95, 0.05, 1.0), Verdict::inconclusive);
  EXPECT_EQ(judge_limit(not_a_number, 0.0, 1.0), Verdict::fail);
  EXPECT_EQ(judge_limit(INFINITY, 0.0, 1.0), Verdict::fail);
  EXPECT_EQ(judge_limit(0.0, 0.0, not_a_number), Verdict::fail);
  EXPECT_EQ(judge_limit(0.0, not_a_number, 1.0), Verdict::inconclusive);
  EXPECT_EQ(judge_limit(0.0, 0.0, 0.0), Verdict::pass);
}

TEST(Verdict, JudgesASignedErrorOnBothSides) {
  EXPECT_EQ(judge_limit(-1.2, 0.05, 1.0), Verdict::fail);
  EXPECT_EQ(judge_band(-0.9, 0.0, 0.7, 1.3), Verdict::fail);
  EXPECT_EQ(judge_band(0.5, 0.0, 0.7, 1.3), Verdict::fail);  // too good is a finding
  EXPECT_EQ(judge_band(1.0, 0.01, 0.7, 1.3), Verdict::pass);
  EXPECT_EQ(judge_band(1.29, 0.01, 0.7, 1.3), Verdict::inconclusive);
  EXPECT_EQ(judge_band(not_a_number, 0.0, 0.7, 1.3), Verdict::fail);
  EXPECT_EQ(judge_at_least(1.9, 0.01, 1.8), Verdict::pass);
  EXPECT_EQ(judge_at_least(-1.9, 0.01, 1.8), Verdict::fail);
  EXPECT_EQ(judge_at_least(1.81, 0.01, 1.8), Verdict::inconclusive);
  EXPECT_EQ(judge_at_least(not_a_number, 0.0, 1.8), Verdict::fail);
}

TEST(Equivalence, NeedsAMarginAndKnowsFourAnswers) {
  EXPECT_EQ(equivalence(0.01, 0.01, 0.1), Equivalence::equivalent);
  EXPECT_EQ(equivalence(0.05, 0.01, 0.1), Equivalence::negligible);
  EXPECT_EQ(equivalence(-0.3, 0.01, 0.1), Equivalence::different);
  EXPECT_EQ(equivalence(0.09, 0.01, 0.1), Equivalence::unresolved);
  EXPECT_EQ(equivalence(not_a_number, 0.01, 0.1), Equivalence::unresolved);
  EXPECT_EQ(equivalence(0.0, 0.01, 0.0), Equivalence::unresolved);
}

}  // namespace
}  // namespace tripoint
