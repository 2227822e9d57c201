// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "references/solids.hpp"
#include "validation/references/beam.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::function;

/// Frequency equation of the clamped-free Timoshenko beam [Huang 1961, J. Appl. Mech. 28]; zero at a root.
double huang(const Beam& b, double w) {
  const double L2 = b.length * b.length, b2 = b.mass * L2 * L2 * w * w / b.bending, r2 = b.rotary / (b.mass * L2), s2 = b.bending / (b.shear * L2), k = std::sqrt(b2);
  const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / b2);
  const double alpha = std::sqrt(0.5 * (root - (r2 + s2))), beta = std::sqrt(0.5 * (root + r2 + s2));
  return 2.0 + (b2 * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(k * alpha) * std::cos(k * beta) -
         k * (r2 + s2) / std::sqrt(1.0 - b2 * r2 * s2) * std::sinh(k * alpha) * std::sin(k * beta);
}

TEST(Beam, HasTheFrequencyOfHuangsEquation) {
  for (const double height : {0.01, 0.02, 0.06}) {
    const auto b = rectangular_beam(0.2, height, 1.0, 1000.0, 2e6, 0.3975, true, 0.862);
    const double w = beam_frequency(b, {});
    EXPECT_LT(huang(b, w * (1 - 1e-9)) * huang(b, w * (1 + 1e-9)), 0.0) << height;  // bisection to round-off
    EXPECT_GT(huang(b, 0.5 * w) * huang(b, 0.05 * w), 0.0);                         // no root below
  }
}

TEST(Beam, IsTheThinPlateOfGrayMonaghanAndSwift) {
  // L = 0.2, H = 0.02, rho = 1000, E = 2e6, nu = 0.3975: thin plate 0.2541 s, shear and rotary inertia take about 1 % off.
  const auto thin = rectangular_beam(0.2, 0.02, 1.0, 1000.0, 2e6, 0.3975, true, 1e9);
  EXPECT_NEAR(2 * test::pi / beam_frequency({thin.length, thin.bending, 1e12, thin.mass, 0.0}, {}), 0.2541, 1e-4);  // as printed
  const auto thick = rectangular_beam(0.2, 0.02, 1.0, 1000.0, 2e6, 0.3975, true, rectangular_shear_coefficient(0.3975, true));
  EXPECT_NEAR(beam_frequency(thick, {}) / (2 * test::pi) * 0.2541, 0.99, 0.005);
}

TEST(Beam, WithAHeavyTipIsASpring) {
  const auto b = rectangular_beam(0.2, 0.02, 0.02, 1e-3, 2e6, 0.3, false, 0.85);  // next to no mass of its own
  const double stiffness = 1.0 / beam_sag(b, {1.0, 0.0, 0.0}, 1.0, b.length).displacement;
  EXPECT_NEAR(beam_frequency(b, {3.0, 0.0, 0.0}), std::sqrt(stiffness / 3.0), 1e-7 * std::sqrt(stiffness / 3.0));  // the beam weighs 8e-8 kg beside 3 kg
}

TEST(Cantilever, TakesTheBeamFromTheScene) {
  const auto s = test::beam(2.0);
  const auto truth = make_reference(function("cantilever"), s.job, s.initial);
  const double E = 2e6 / (1 - 0.3975 * 0.3975), EI = E * 0.02 * 8e-6 / 12, q = 1000 * 0.02 * 0.02 * 2.0, L = 0.2, x = 0.195;
  const double kGA = 10.0 / (12.0 - 0.3975) * 2e6 / (2 * 1.3975) * 4e-4;
  EXPECT_NEAR(*truth->number("deflection"), q * x * x * (6 * L * L - 4 * L * x + x * x) / (24 * EI) + q * (L * x - x * x / 2) / kGA, 1e-12);
  EXPECT_EQ(*truth->number("end"), 1.0);
  EXPECT_EQ(*truth->number("direction.z"), -1.0);
  EXPECT_FALSE(truth->number("tip_deflection"));
  const auto weightless = test::beam(0.0);
  const auto free = make_reference(function("cantilever"), weightless.job, weightless.initial);
  EXPECT_FALSE(free->number("deflection"));
  EXPECT_EQ(*free->number("direction.z"), 1.0);  // the thinner side that is not periodic
  EXPECT_EQ(*free->number("frequency"), *truth->number("frequency"));
}

TEST(Cantilever, CarriesARigidTip) {
  const auto s = test::beam(2.0, true);
  const auto truth = make_reference(function("cantilever", {{"tip", std::string("tip")}}), s.job, s.initial);
  const auto bare = make_reference(function("cantilever"), s.job, s.initial);
  EXPECT_LT(*truth->number("frequency"), 0.3 * *bare->number("frequency"));
  EXPECT_GT(*truth->number("tip_deflection"), *truth->number("deflection"));
  EXPECT_GT(*truth->number("deflection"), *bare->number("deflection"));
  EXPECT_THROW((void)make_reference(function("cantilever", {{"tip", std::string("clamp")}}), s.job, s.initial), InputError);
}

}  // namespace
}  // namespace tripoint
