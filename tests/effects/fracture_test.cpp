// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numeric>

#include "effects/fracture/bond_limit.hpp"
#include "effects/fracture/fracture.hpp"
#include "effects/solid_lab.hpp"
#include "solids/objects.hpp"

namespace tripoint {
namespace {

/// A bar of 2 x 2 x 12 spacings whose ends fly apart faster than its bonds can hold.
lab::Lab bar_pulled_apart(double dt = 0.02) {
  lab::Lab lab = lab::elastic_lab(1.0);
  lab.scene.materials[0].fracture_stretch = 1.1;
  lab.scene.time_step = dt;
  lab.add({.name = "bar", .corner = {-5.5, -0.5, -0.5}, .count = {12, 2, 2}, .phase = Phase::elastic});
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    lab.initial.velocity[i] = {0.1 * lab.initial.position[i].x, 0.0, 0.0};
  return lab;
}
std::size_t bodies_alive(const Simulation& s) {
  const auto alive = s.state().bodies[field::body_alive];
  return static_cast<std::size_t>(std::accumulate(alive.begin(), alive.end(), 0));
}
double total_energy(const Ledger& l) {
  return std::accumulate(l.energy.begin(), l.energy.end(), 0.0,
                         [](double sum, const auto& entry) { return sum + entry.second; });
}

TEST(BondLimit, IsTheSameForShortAndLongBondsByStretchAndNotByDistance) {
  const Vec3 shorter{1.0, 0.0, 0.0}, longer{2.0, 0.0, 0.0};
  EXPECT_FALSE(fracture::breaks_by_stretch(1.09 * shorter, shorter, 1.1));
  EXPECT_FALSE(fracture::breaks_by_stretch(1.09 * longer, longer, 1.1));
  EXPECT_TRUE(fracture::breaks_by_stretch(1.11 * longer, longer, 1.1));
  EXPECT_FALSE(fracture::breaks_by_distance(1.5 * shorter, 2.2));
  EXPECT_TRUE(fracture::breaks_by_distance(1.11 * longer, 2.2));
}

TEST(BondLimit, OfTwoMaterialsIsTheLower) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].fracture_stretch = 1.2;
  const fracture::BondLimits limits(scene);
  Bond bond;
  bond.x = {1.0, 0.0, 0.0};
  EXPECT_TRUE(limits.breaks({1.3, 0.0, 0.0}, bond, 0, 1));
  EXPECT_FALSE(limits.breaks({1.3, 0.0, 0.0}, bond, 1, 1));
}

TEST(Fracture, MakesBodiesOfTheParts) {
  const Simulation s = bar_pulled_apart().run(8.0);
  const State& w = s.state();
  EXPECT_GE(bodies_alive(s), 2u);
  EXPECT_EQ(bodies_alive(s), count_objects(w));
  EXPECT_EQ(w.body_names.at(1), "bar.1");
  const auto body = w.particles[field::body];
  for (std::uint32_t id = 0; id < w.particles.size(); ++id) {
    const int own = body[w.particles.row(id)];
    for (const Bond& b : w.bonds.of(id)) EXPECT_EQ(body[w.particles.row(b.other)], own);
    for (const ExcludedPair& pair : w.own.of(id)) EXPECT_EQ(body[w.particles.row(pair.other)], own);
  }
}

TEST(Fracture, KeepsMomentaToRoundOff) {
  lab::Lab lab = bar_pulled_apart();
  for (Vec3& v : lab.initial.velocity) v += {0.0, 0.3, 0.0};
  Simulation start(lab.scene, lab.initial), end = lab.run(8.0);
  EXPECT_GT(bodies_alive(end), 1u);
  const Ledger before = start.ledger(), after = end.ledger();
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-12 * norm(before.momentum));
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-12 * 48.0 * 0.3 * 5.5);
}

/// What the step leaves (5.0e-4 and 1.2e-4 of the energy) falls with its square; what broken bonds let go is
/// an entry of its own.
TEST(Fracture, AccumulatesTheEnergyThatItLetsGo) {
  double left[2] = {};
  for (const int halvings : {0, 1}) {
    const lab::Lab lab = bar_pulled_apart(0.05 / (1 << halvings));
    Simulation start(lab.scene, lab.initial), end = lab.run(8.0);
    const Ledger before = start.ledger(), after = end.ledger();
    EXPECT_GT(after.energy.at("fracture"), 0.05 * before.energy.at("kinetic"));
    EXPECT_NEAR(total_energy(after) / total_energy(before), 1.0, 1e-12);
    left[halvings] = std::abs(after.energy.at("time_integration")) / before.energy.at("kinetic");
  }
  EXPECT_LT(left[0], 1e-3);
  EXPECT_LT(left[1], 0.35 * left[0]);
}

/// P (eps - eps_p) P of particles that keep three directions, by id.
std::vector<Symmetric> elastic_strains(const State& w) {
  std::vector<Symmetric> list;
  for (std::uint32_t id = 0; id < w.particles.size(); ++id)
    list.push_back(solid::deformation_of(w, id).strain -
                   solid::plastic_strain_of(w.particles, w.particles.row(id)));
  return list;
}

/// Without this a bar that has flowed would see its plastic strain as elastic strain of the other sign, and
/// gain energy by tearing.
TEST(Fracture, LeavesTheStressOfWhatHasFlowedAsItWas) {
  lab::Lab lab = bar_pulled_apart();
  lab.scene.materials[0].elastic_limit = 0.01;
  lab.scene.materials[0].fracture_stretch.reset();
  State w = lab.run(1.0).state();
  w.scene.materials[0].fracture_stretch = 1.06;
  const std::vector<Symmetric> before = elastic_strains(w);
  w.accumulated.open(EnergyAccount{"fracture"});  // the run that made this state could not break
  const auto effect = fracture::make(w.scene);
  effect->change(w);
  const std::vector<Symmetric> after = elastic_strains(w);
  std::size_t changed = 0;
  for (const std::uint32_t id : w.change.relisted) {
    const std::size_t i = w.particles.row(id);
    if (w.particles[field::shape_rank][i] != 3 || w.bonds.of(id).empty()) continue;
    const Symmetric jump = after[id] - before[id];
    EXPECT_LT(std::sqrt(contraction(jump, jump)), 1e-14) << "particle " << id;
    ++changed;
  }
  EXPECT_GT(changed, 4u);
  EXPECT_GE(w.accumulated[EnergyAccount{"fracture"}], 0.0);
}

TEST(Fracture, GoesOnBitForBitFromACheckpoint) {
  lab::Lab lab = bar_pulled_apart(0.1);
  lab.scene.materials[0].elastic_limit = 0.01;
  // Before the first bond breaks, and with parts that have become bodies
  for (const double cut : {1.5, 5.0}) {
    Simulation whole(lab.scene, lab.initial, {});
    whole.advance_to(cut);
    Simulation rest(lab.scene, lab.initial, {}, whole.checkpoint());
    whole.advance_to(8.0);
    rest.advance_to(8.0);
    EXPECT_GT(bodies_alive(whole), 1u);
    EXPECT_EQ(whole.checkpoint().real, rest.checkpoint().real);
    EXPECT_EQ(whole.checkpoint().whole, rest.checkpoint().whole);
  }
}

TEST(Fracture, IsTheSameWithTwoThreads) {
  const lab::Lab lab = bar_pulled_apart(0.1);
  const Simulation one = lab.run(4.0), two = lab.run(4.0, 2);
  EXPECT_GT(one.state().accumulated[EnergyAccount{"fracture"}], 0.0);
  EXPECT_EQ(lab::by_id(one, field::position.x), lab::by_id(two, field::position.x));
  EXPECT_EQ(one.state().accumulated[EnergyAccount{"fracture"}],
            two.state().accumulated[EnergyAccount{"fracture"}]);
}

}  // namespace
}  // namespace tripoint
