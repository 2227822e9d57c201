// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "effects/plastic/flow.hpp"

namespace tripoint::plastic {
namespace {

using solid::ElasticConstants;

constexpr Symmetric all{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
constexpr double round_off = 1e-14;

const ElasticConstants& material() {
  static const ElasticConstants c = solid::elastic_constants(2.0e6, 0.3);
  return c;
}
Symmetric random_strain(std::mt19937& engine, double scale) {
  std::uniform_real_distribution<double> u(-scale, scale);
  return {u(engine), u(engine), u(engine), u(engine), u(engine), u(engine)};
}
Symmetric stress_of(const Symmetric& elastic) { return solid::stress(elastic, all, 3, material()); }
double stored(const Symmetric& elastic) { return 0.5 * contraction(elastic, stress_of(elastic)); }

TEST(PlasticFlow, EndsOnTheYieldSurfaceOfJ2WithYieldStressRootSixMuG1) {
  std::mt19937 engine(1);
  const YieldLimits limits{.elastic = 0.01};
  for (int n = 0; n < 100; ++n) {
    const Symmetric strain = random_strain(engine, 0.1), plastic = flowed(strain, {}, limits);
    EXPECT_NEAR(von_mises(stress_of(strain - plastic)) / yield_stress(material().mu, 0.01), 1.0, 1e-13);
  }
}

TEST(PlasticFlow, KeepsTheVolumeAndThePressure) {
  std::mt19937 engine(2);
  const Symmetric strain = random_strain(engine, 0.1), plastic = flowed(strain, {}, {.elastic = 0.01});
  EXPECT_NEAR(trace(plastic), 0.0, 1e-16);
  EXPECT_NEAR(trace(stress_of(strain - plastic)) / trace(stress_of(strain)), 1.0, round_off);
}

TEST(PlasticFlow, DoesNothingBelowTheLimitAndNothingTwice) {
  std::mt19937 engine(3);
  const YieldLimits limits{.elastic = 0.01};
  for (int n = 0; n < 100; ++n) {
    const Symmetric strain = random_strain(engine, 0.1),
                    small = (0.99 * 0.01 / size(deviator(strain))) * strain;
    EXPECT_EQ(flowed(small, {}, limits), Symmetric{});
    const Symmetric once = flowed(strain, {}, limits);
    EXPECT_EQ(flowed(strain, once, limits), once);
  }
}

/// At a strain that is held the stored energy loses that much, and mu |flow|^2 more: what is second order in
/// a step.
TEST(PlasticFlow, NeverGivesEnergyAndAccumulatesWhatTheStoredEnergyLoses) {
  std::mt19937 engine(4);
  const YieldLimits limits{.elastic = 0.01, .plastic = 0.05};
  Symmetric plastic;
  for (int n = 0; n < 1000; ++n) {
    const Symmetric strain = random_strain(engine, 0.1), next = flowed(strain, plastic, limits),
                    flow = next - plastic;
    const double lost = dissipated(stress_of(strain - next), flow);
    EXPECT_GE(lost, 0.0);
    EXPECT_NEAR(lost + material().mu * contraction(flow, flow),
                stored(strain - plastic) - stored(strain - next), 1e-12 * stored(strain - plastic));
    plastic = next;
  }
}

TEST(PlasticFlow, StopsAtThePlasticLimitAndLeavesWhatWasLargerBefore) {
  std::mt19937 engine(5);
  const YieldLimits limits{.elastic = 0.01, .plastic = 0.02};
  Symmetric plastic;
  for (int n = 0; n < 100; ++n) {
    plastic = flowed(random_strain(engine, 0.1), plastic, limits);
    EXPECT_LE(size(plastic), 0.02 * (1.0 + round_off));
  }
  const Symmetric large{0.04, -0.02, -0.02, 0.0, 0.0, 0.0};  // |large| = 0.049
  EXPECT_NEAR(size(flowed({0.2, 0.0, 0.0, 0.0, 0.0, 0.0}, large, limits)), size(large), round_off);
}

/// Uniaxial tension of a chain: S = E eps up to sqrt(6) mu g1, and the cap on the isochoric tensor (p, -p/2,
/// -p/2).
TEST(PlasticFlow, OfAChainYieldsInTensionWhereABarDoes) {
  constexpr Symmetric P{1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const double sigma = yield_stress(material().mu, 0.01);
  const Symmetric strain{0.05, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto chain_stress = [&](const Symmetric& e) { return solid::stress(e, P, 1, material()); };
  const Symmetric plastic = flowed_flat(strain, chain_stress(strain), {}, 1, sigma, 1.0);
  EXPECT_NEAR(chain_stress(strain - plastic).xx / sigma, 1.0, round_off);
  EXPECT_EQ(between(P, plastic), plastic);
  const Symmetric most = flowed_flat(strain, chain_stress(strain), {}, 1, sigma, 0.01);
  EXPECT_NEAR(most.xx, 0.01 / std::sqrt(1.5), round_off);
}

TEST(PlasticFlow, OfASheetEndsOnTheYieldSurfaceWithinItsPlane) {
  constexpr Symmetric P{1.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  const double sigma = yield_stress(material().mu, 0.01);
  std::mt19937 engine(6);
  for (int n = 0; n < 100; ++n) {
    const Symmetric strain = between(P, random_strain(engine, 0.1));
    const auto sheet_stress = [&](const Symmetric& e) { return solid::stress(e, P, 2, material()); };
    const Symmetric plastic = flowed_flat(strain, sheet_stress(strain), {}, 2, sigma, 1.0);
    EXPECT_EQ(between(P, plastic), plastic);
    EXPECT_LE(von_mises(sheet_stress(strain - plastic)) / sigma, 1.0 + 1e-13);
    EXPECT_GE(dissipated(sheet_stress(strain - plastic), plastic), 0.0);
  }
}

}  // namespace
}  // namespace tripoint::plastic
