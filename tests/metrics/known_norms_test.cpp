// SPDX-License-Identifier: BSD-3-Clause
// Norms, fits and units by figures that are worked out by hand, and at the edges where they begin to hold.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/known.hpp"
#include "validation/metrics/dominant_frequency.hpp"
#include "validation/metrics/members.hpp"
#include "validation/metrics/norms.hpp"
#include "validation/metrics/order.hpp"
#include "validation/metrics/power_law.hpp"
#include "validation/metrics/solid_motion.hpp"
#include "validation/metrics/statistics.hpp"

namespace tripoint {
namespace {

using test::Known;
using test::metric;
using test::pi;
using test::Still;

// --- norms in space

FrameError two_samples(bool with_errors) {
  FrameError e;
  e.add(3.0, 1.0, 10);
  e.add(-1.0, 3.0, 11);
  if (with_errors) e.sigma = {1.0, 0.5};
  return e;
}

TEST(KnownNorms, WeighTheSamplesAndTheirStandardErrors) {
  const auto plain = two_samples(false), noisy = two_samples(true);
  const auto check = [](const NormValue& v, double value, double uncertainty, const char* name) {
    EXPECT_NEAR(v.value, value, 1e-14) << name;
    EXPECT_NEAR(v.uncertainty, uncertainty, 1e-14) << name;
  };
  check(spatial_norm(Norm::L1, plain), 1.5, 0.0, "(3 + 3)/4");
  check(spatial_norm(Norm::L2, plain), std::sqrt(3.0), 0.0, "(9 + 3)/4");
  check(spatial_norm(Norm::L2raw, plain), std::sqrt(3.0), 0.0, "the same");
  check(spatial_norm(Norm::Linf, plain), 3.0, 0.0, "the first");
  // shares 1/4 and 3/4; sigma^2 1 and 1/4; noise (1 + 3/4)/4; e^2 - sigma^2 = 8 and 3/4
  const double square = 3.0 - 0.4375,
               variance = (2.0 * 1.0 + 4.0 * 8.0 * 1.0) / 16.0 + 9.0 / 16.0 * (2.0 / 16.0 + 0.75),
               u = std::sqrt(square + std::sqrt(variance)) - std::sqrt(square);
  check(spatial_norm(Norm::L2, noisy), std::sqrt(square), u, "noise taken off");
  check(spatial_norm(Norm::L2raw, noisy), std::sqrt(3.0), u, "noise left in");
  check(spatial_norm(Norm::L1, noisy), 1.5, std::sqrt(1.0 / 16.0 + 9.0 / 64.0 + 2.0 / pi * 0.625 * 0.625),
        "L1");
  check(spatial_norm(Norm::Linf, noisy), 3.0, std::sqrt(2.0 * std::log(2.0)), "the larger of two");
  check(spatial_norm(Norm::chi, noisy), std::sqrt(6.5), 0.5, "(9 + 4)/2, 1/sqrt(2 x 2)");
  EXPECT_EQ(spatial_norm(Norm::Linf, plain).worst, 10);
}

TEST(KnownNorms, HaveNoNegativeSquareAndNoErrorOfNothing) {
  auto e = two_samples(true);
  e.error = {0.1, 0.1};
  EXPECT_EQ(spatial_norm(Norm::L2, e).value, 0.0);
  EXPECT_GT(spatial_norm(Norm::L2, e).uncertainty, 0.0);
  e.sigma[1] = 0.0;
  EXPECT_TRUE(std::isnan(spatial_norm(Norm::chi, e).value));
  EXPECT_TRUE(std::isnan(spatial_norm(Norm::chi, two_samples(false)).value));
  FrameError eight;
  for (int n = 0; n < 8; ++n) {
    eight.add(n == 5 ? -4.0 : 1.0, 1.0, n);
    eight.sigma.push_back(n == 2 ? 0.3 : 0.1);
  }
  EXPECT_NEAR(spatial_norm(Norm::Linf, eight).uncertainty, 0.3 * std::sqrt(2.0 * std::log(8.0)), 1e-14);
  EXPECT_EQ(spatial_norm(Norm::Linf, eight).worst, 5);
  EXPECT_EQ(spatial_norm(Norm::Linf, eight).value, 4.0);
}

TEST(KnownNorms, KeepTheSignOfASingleNumberOnly) {
  EXPECT_EQ(spatial_norm(Norm::Linf, single(-2.0)).value, -2.0);
  FrameError body;
  body.add(-2.0, 1.0, 0);
  EXPECT_EQ(spatial_norm(Norm::Linf, body).value, 2.0);
  auto two = single(-2.0);
  two.add(1.0, 1.0, -1);
  EXPECT_EQ(spatial_norm(Norm::Linf, two).value, 2.0);
}

TEST(KnownNorms, AreNoneWithoutSamplesWeightOrFiniteErrors) {
  FrameError none, light = two_samples(false), endless = two_samples(false);
  light.weight = {0.0, 0.0};
  endless.error[1] = std::numeric_limits<double>::infinity();
  for (const auto norm : {Norm::L1, Norm::L2, Norm::L2raw, Norm::Linf, Norm::chi})
    for (const auto* e : {&none, &light, &endless}) EXPECT_TRUE(std::isnan(spatial_norm(norm, *e).value));
}

TEST(KnownNorms, TheFourKindsOfUncertaintyAddInSquares) {
  EXPECT_NEAR((Uncertainty{1.0, 2.0, 4.0, 10.0}).combined(), 11.0, 1e-14);
}

// --- heat of a material

TEST(KnownHeat, OfASolidUpToItsMeltingAndOfALiquidFromThere) {
  Material water;
  water.heat_capacity = 4000.0;
  water.latent_heat = 3e5;
  water.t_melt = 273.0;
  Snapshot s;
  s.temperature = {283.0};
  const auto heat = [&](std::vector<double> fraction, std::vector<int> phase) {
    s.liquid_fraction = std::move(fraction);
    s.phase = std::move(phase);
    return static_cast<double>(heat_per_mass(water, s, 0));
  };
  EXPECT_NEAR(heat({}, {0}), 1132000.0, 1e-6);
  EXPECT_NEAR(heat({0.25}, {0}), 1132000.0 + 75000.0, 1e-6);
  water.solid_heat_capacity = 2000.0;
  EXPECT_NEAR(heat({}, {0}), 1132000.0, 1e-6);
  EXPECT_NEAR(heat({}, {1}), 566000.0, 1e-6);
  EXPECT_NEAR(heat({}, {2}), 566000.0, 1e-6);
  EXPECT_NEAR(heat({}, {}), 566000.0, 1e-6);
  EXPECT_NEAR(heat({0.0}, {1}), 566000.0, 1e-6);
  EXPECT_NEAR(heat({1.0}, {0}), 546000.0 + 300000.0 + 40000.0, 1e-6);
  EXPECT_NEAR(heat({0.25}, {0}), 0.75 * 566000.0 + 0.25 * 886000.0, 1e-6);
}

// --- a frequency

using List = std::vector<double>;

/// f at n equal times, one unit apart.
template <class F>
DominantFrequency of_function(int n, F f) {
  List t, y;
  for (int k = 0; k < n; ++k) {
    t.push_back(k);
    y.push_back(f(static_cast<double>(k)));
  }
  return dominant_frequency(t, y);
}

TEST(KnownFrequency, OfASineBesideAFasterSwing) {
  const auto d = of_function(
      64, [](double t) { return 7.0 + 3.0 * std::cos(2.0 * pi * 5.0 * t / 64.0) + 0.1 * std::cos(pi * t); });
  EXPECT_NEAR(d.frequency, 5.0 / 64.0, 1e-4);
  EXPECT_NEAR(d.amplitude, 3.0, 0.01);
  EXPECT_NEAR(d.share, 1.0 - 0.01 / 4.51, 1e-4);
  // sqrt(6/n) s/(pi T A), s^2 = what is left over n - 4 [least squares of a sine in noise]
  EXPECT_NEAR(d.uncertainty, std::sqrt(6.0 / 64.0) * std::sqrt(0.64 / 60.0) / (pi * 63.0 * 3.0), 1e-6);
}

TEST(KnownFrequency, IsNoneOfAChangeInTheLastDigits) {
  const auto swing = [](double size) {
    return of_function(16, [=](double t) { return 1.0 + size * std::sin(1.2 * t); });
  };
  EXPECT_NE(swing(5e-13).problem.find("does not change"), std::string::npos);
  EXPECT_EQ(swing(3e-12).problem, "");
}

TEST(KnownFrequency, NeedsEightTimesAndOneAndAHalfSwings) {
  const auto turns = [](int n, double count) {
    return of_function(n, [=](double t) { return std::sin(2.0 * pi * count * t / (n - 1.0)); });
  };
  EXPECT_NE(turns(7, 1.6).problem.find("eight output times"), std::string::npos);
  EXPECT_NEAR(turns(8, 1.62).frequency, 1.62 / 7.0, 1e-6);
  EXPECT_NE(turns(40, 1.2).problem.find("swings less"), std::string::npos);
  EXPECT_NEAR(turns(40, 1.6).frequency, 1.6 / 39.0, 1e-6);
  EXPECT_NEAR(turns(40, 9.6).frequency, 9.6 / 39.0, 1e-6);  // 39/4 = 9.75 periods are the most
  EXPECT_NE(turns(40, 9.9).problem.find("too fast"), std::string::npos);
}

TEST(KnownFrequency, ExplainsHalfOfTheVarianceAtLeast) {
  const auto sum = [](double other) {
    return of_function(120, [=](double t) {
      return std::sin(2.0 * pi * 5.0 * t / 120.0) +
             other * (std::sin(2.0 * pi * 11.0 * t / 120.0) + std::sin(2.0 * pi * 19.0 * t / 120.0));
    });
  };
  EXPECT_EQ(sum(0.6).problem, "");  // 1/(1 + 0.72)
  EXPECT_NE(sum(0.8).problem.find("no single frequency"), std::string::npos);
  // 1/(1 + 1.28): 44 %
  EXPECT_NE(sum(0.8).problem.find("explains 4"), std::string::npos) << sum(0.8).problem;
}

TEST(KnownFrequency, OfASwingIsLookedForFromTwoFifthsToFiveHalves) {
  List t, y;
  for (int n = 0; n < 200; ++n) {
    t.push_back(0.5 * n);
    y.push_back(0.3 + 2.0 * std::cos(1.0 * t.back() + 0.4));
  }
  for (const double guess : {0.42, 1.0, 2.4}) {
    const auto s = fit_swing(t, y, guess);
    EXPECT_EQ(s.problem, "") << guess;
    EXPECT_NEAR(s.frequency, 1.0, 1e-7);
    EXPECT_NEAR(s.amplitude, 2.0, 1e-7);
    EXPECT_NEAR(s.offset, 0.3, 1e-7);
  }
  for (const double guess : {0.38, 2.6}) EXPECT_NE(fit_swing(t, y, guess).problem, "") << guess;
}

// --- fits over levels

TEST(KnownFits, StudentsFactorIsThatOfTheTables) {
  EXPECT_TRUE(std::isinf(student_95(0)));
  EXPECT_NEAR(student_95(1), 12.706, 1e-3);
  EXPECT_NEAR(student_95(2), 4.303, 1e-3);
  EXPECT_NEAR(student_95(10), 2.228, 1e-3);
}

TEST(KnownFits, AkaikesCriterionIsCorrectedWhereSamplesAreLeft) {
  EXPECT_NEAR(akaike(5.0, 5, 2), 4.0 + 12.0 / 2.0, 1e-12);  // n ln 1 + 2 k + 2 k (k + 1)/(n - k - 1)
  EXPECT_NEAR(akaike(3.0, 3, 2), 4.0, 1e-12);
  EXPECT_NEAR(akaike(4.0, 4, 2), 4.0 + 12.0, 1e-12);
  EXPECT_NEAR(akaike(4.0 * std::exp(1.0), 4, 3), 4.0 + 6.0, 1e-12);
  EXPECT_NEAR(akaike(0.0, 10, 2), 10.0 * std::log(1e-27) + 4.0 + 12.0 / 7.0, 1e-9);
}

TEST(KnownFits, APowerLawHasTheIntervalOfALine) {
  // ln e = 2 ln h + (0.1, -0.2, 0.1) at ln h = 0, -1, -2: the slope stays 2, the squares that are left are
  // 0.06, one degree of freedom
  List h, e;
  const double off[] = {0.1, -0.2, 0.1};
  for (int n = 0; n < 3; ++n) {
    h.push_back(std::exp(-n));
    e.push_back(-std::exp(-2.0 * n + off[n]));
  }
  const auto fit = fit_power_law(h, e);
  EXPECT_NEAR(fit.order.value, 2.0, 1e-12);
  EXPECT_NEAR(fit.residual, 0.06, 1e-12);
  EXPECT_NEAR(fit.coefficient, 1.0, 1e-12);
  const double half = 12.7062 * std::sqrt(0.06 / 1.0 / 2.0);
  EXPECT_NEAR(fit.order.low, 2.0 - half, 1e-4);
  EXPECT_NEAR(fit.order.high, 2.0 + half, 1e-4);
  const auto two = fit_power_law({2.0, 1.0}, {8.0, 1.0});
  EXPECT_NEAR(two.order.value, 3.0, 1e-12);
  EXPECT_TRUE(std::isinf(two.order.low) && std::isinf(two.order.high));
}

TEST(KnownFits, AFloorIsFoundWithItsPower) {
  List h, e;
  for (int n = 0; n < 6; ++n) {
    h.push_back(std::pow(0.5, n));
    e.push_back(0.25 + 3.0 * std::pow(h.back(), 1.5));
  }
  const auto fit = fit_floored_power_law(h, e);
  ASSERT_TRUE(fit.found);
  EXPECT_NEAR(fit.order.value, 1.5, 1e-5);
  EXPECT_NEAR(fit.floor.value, 0.25, 1e-6);
  EXPECT_NEAR(fit.coefficient, 3.0, 1e-5);
  EXPECT_LT(fit.residual, 1e-10);
  EXPECT_FALSE(fit_floored_power_law({4.0, 2.0, 1.0}, {17.0, 5.0, 2.0}).found);
  for (const double p : {0.1, 9.0}) {
    List steep;
    for (const double x : h) steep.push_back(1.0 + std::pow(x, p));
    EXPECT_FALSE(fit_floored_power_law(h, steep).found) << p;
  }
}

TEST(KnownFits, TheUncertaintyOfAGridIsAShareOfItsOwnError) {
  const auto series = [](const List& h, double p) {
    List value;
    for (const double x : h) value.push_back(1.0 + 0.1 * std::pow(x, p));
    return value;
  };
  const auto all = [&](const List& h, double p, double formal) {
    return grid_convergence_uncertainties(h, series(h, p), formal);
  };
  // two grids: factor 3 on the difference over r^p - 1, half of it as a standard uncertainty
  const auto two = all({2.0, 1.0}, 2.0, 2.0);
  EXPECT_NEAR(two[1], 0.5 * 3.0 * 0.3 / 3.0, 1e-12);
  EXPECT_NEAR(two[0], 4.0 * two[1], 1e-12);
  // the order seen is the formal one: factor 1.25 on each level's error
  for (const List& h : {List{4.0, 2.0, 1.0}, List{8.0, 4.0, 2.0, 1.0}})
    for (std::size_t n = 0; n < h.size(); ++n)
      EXPECT_NEAR(all(h, 2.0, 2.0)[n], 0.5 * 1.25 * 0.1 * h[n] * h[n], 1e-5);
  // above the formal one: factor 3 on that of a fixed power, which here is 2
  const List four{8.0, 4.0, 2.0, 1.0};
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_NEAR(all(four, 2.0, 1.0)[n], 0.5 * 3.0 * 0.1 * four[n] * four[n], 1e-9);
  EXPECT_EQ(grid_convergence_uncertainties({4.0, 2.0, 1.0}, {5.0, 5.0, 5.0}, 2.0), (List{0.0, 0.0, 0.0}));
  for (const auto& none : {grid_convergence_uncertainties({1.0}, {1.0}, 2.0),
                           grid_convergence_uncertainties({2.0, 1.0}, {1.0}, 2.0),
                           grid_convergence_uncertainties({2.0, 1.0}, {1.0, 2.0}, 0.0),
                           grid_convergence_uncertainties({2.0, 1.0}, {1.0, std::nan("")}, 2.0)})
    for (const double u : none) EXPECT_TRUE(std::isnan(u));
}

TEST(KnownFits, EachClassOfAnOrderBeginsAtItsEdge) {
  const List h{8.0, 4.0, 2.0, 1.0};
  const auto of = [&](const List& e, const List& u = {}, double formal = 0.0) {
    return fit_order(h, e, u, formal).fit_class;
  };
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}), FitClass::asymptotic);
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {}, 2.0), FitClass::asymptotic);
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {}, 1.4), FitClass::preasymptotic);
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {0.0, 0.0, 2.1, 0.6}), FitClass::noise_limited);
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {0.0, 0.0, 2.1, 0.5}), FitClass::asymptotic);  // 1 = 2 x 0.5 is seen
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {0.0, 0.0, 1.9, 0.6}), FitClass::asymptotic);
  EXPECT_EQ(of({64.0, 16.0, 4.0, 1.0}, {2.0}), FitClass::asymptotic);  // no uncertainty of each: none
  EXPECT_EQ(of({1.0, 4.0, 16.0, 64.0}), FitClass::diverging);
  EXPECT_EQ(of({1.0, 0.0, 1.0, 1.0}), FitClass::oscillating);
  EXPECT_EQ(of({8.0, -4.0, 2.0, -1.0}), FitClass::oscillating);
  EXPECT_EQ(of({0.0, 0.0, 0.0, 0.0}), FitClass::roundoff);
  EXPECT_EQ(of({1.0, 2.0, std::nan(""), 1.0}), FitClass::diverging);
  EXPECT_EQ(fit_order({4.0, 2.0, 1.0}, {16.0, 4.0, 1.0}, {}, 0.0).fit_class, FitClass::too_few);
  EXPECT_NEAR(fit_order({4.0, 2.0, 1.0}, {16.0, 4.0, 1.0}, {}, 0.0).value, 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(fit_order({1.0}, {1.0}, {}, 0.0).value));
  EXPECT_TRUE(std::isnan(fit_order({2.0, 1.0}, {1.0}, {}, 0.0).value));
  EXPECT_NEAR(fit_order({2.0, 1.0}, {8.0, 1.0}, {}, 0.0).value, 3.0, 1e-12);
}

// --- a stationary mean

TEST(KnownMeans, CutWhatIsNotYetSteadyAndNoMoreThanHalf) {
  List x{9.0, 9.0, 9.0, 9.0};
  for (int n = 0; n < 16; ++n) x.push_back(n % 2 == 0 ? 1.0 : -1.0);
  EXPECT_EQ(stationary_mean(x).burn_in, 4u);
  EXPECT_NEAR(stationary_mean(x).value, 0.0, 1e-15);
  List late(12, 9.0);
  for (int n = 0; n < 8; ++n) late.push_back(n % 2 == 0 ? 1.0 : -1.0);
  EXPECT_LE(stationary_mean(late).burn_in, 10u);
  EXPECT_TRUE(std::isnan(stationary_mean(List(7, 1.0)).value));
  EXPECT_EQ(stationary_mean(List(8, 1.0)).value, 1.0);
  EXPECT_EQ(stationary_mean(List(8, 1.0)).uncertainty, 0.0);
  EXPECT_EQ(stationary_mean(List(8, 1.0)).effective, 8.0);
  List endless(9, 1.0);
  endless[8] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(stationary_mean(endless).value));
}

}  // namespace
}  // namespace tripoint
