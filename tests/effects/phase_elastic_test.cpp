// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/phase/joining.hpp"
#include "effects/phase_lab.hpp"
#include "scene/shared_terms.hpp"
#include "solids/objects.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint {
namespace {

using lab::cold;
using lab::constant;
using lab::hot;
constexpr double dx = 0.1, young = 1e5;

/// A block of elastic matter and one liquid particle beside it, as it is when it has been loaded.
State block_and_drop(std::array<int, 3> count, const Vec3& drop) {
  lab::Lab lab = lab::melting_lab(dx, {.solid = SolidKind::elastic});
  lab.scene.materials[0].stiffness = 1e-12;
  lab.add({.name = "block", .count = count, .phase = Phase::elastic, .temperature = constant(cold)});
  lab.add({.name = "drop",
           .corner = drop,
           .count = {1, 1, 1},
           .phase = Phase::liquid,
           .temperature = constant(345.0)});
  lab.scene.materials[0].t_solid = 340.0;
  const Simulation s(lab.scene, lab.initial);
  return s.state();
}

double energy_of_all(const State& state) {
  double sum = 0.0;
  for (std::uint32_t id = 0; id < state.particles.size(); ++id)
    sum += solid::deformation_energy(state, id).total();
  return sum;
}

/// Moves every particle by a turn of 90 degrees and a stretch of 5 % along x.
void turn_and_stretch(State& state, double stretch) {
  const auto x = positions(state.particles);
  const Quaternion q =
      from_rotation_vector(0.5 * std::numbers::pi * Vec3{1.0, 2.0, -0.5} / norm(Vec3{1.0, 2.0, -0.5}));
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    Vec3 r = x.at(i);
    r.x *= 1.0 + stretch;
    r.y *= 1.0 - 0.3 * stretch;
    x.set(i, rotate(q, r));
  }
}

Event heat(double time, double temperature, std::optional<double> beyond = {}) {
  Event e;
  e.kind = Event::Kind::heat;
  e.time = time;
  e.until = time + 1e-4;
  e.temperature = temperature;
  if (!beyond) return e;
  e.region.emplace();
  e.region->kind = Shape::Kind::half_space;
  e.region->point = {*beyond, 0.0, 0.0};
  e.region->normal = {-1.0, 0.0, 0.0};
  return e;
}

/// What the energy of the block jumps by as the drop freezes to it.
double jump(State state) {
  const std::uint32_t drop = static_cast<std::uint32_t>(state.particles.size() - 1);
  std::vector<phase::Joint> joints;
  for (std::uint32_t j = 0; j < drop; ++j) {
    const Vec3 r = state.particles.position(state.particles.row(drop)) -
                   state.particles.position(state.particles.row(j));
    if (norm(r) < 1.5 * dx) joints.push_back({drop, j, r, false});
  }
  EXPECT_GT(joints.size(), 0u);
  const double before = energy_of_all(state);
  phase::bond(state, joints);
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id <= drop; ++id) ids.push_back(id);
  state.particles[field::body][state.particles.row(drop)] = 0;
  state.particles[field::phase][state.particles.row(drop)] = 1;
  solid::refresh_shapes(state, ids);
  return energy_of_all(state) - before;
}

TEST(Freezing, BesideATurnedAndStretchedSolidMakesNothingJump) {
  for (const double stretch : {0.0, 0.05}) {
    State block = block_and_drop({5, 5, 5}, {0.2, 0.2, 0.5});
    turn_and_stretch(block, stretch);
    EXPECT_NEAR(jump(block), 0.0, 1e-12 * young * dx * dx * dx);  // present vectors instead: 0.05 E dx^3
  }
}

TEST(Freezing, BesideTurnedChainsAndSheetsMakesNothingJump) {
  for (const auto& [count, drop] : {std::pair{std::array{6, 1, 1}, Vec3{0.6, 0.0, 0.0}},
                                    std::pair{std::array{5, 5, 1}, Vec3{0.5, 0.2, 0.0}}}) {
    State block = block_and_drop(count, drop);
    turn_and_stretch(block, 0.0);
    EXPECT_NEAR(jump(block), 0.0, 1e-12 * young * dx * dx * dx);
  }
}

TEST(Freezing, OfElasticMatterBesideATurnedRigidBodyMakesNothingJump) {
  lab::Lab lab = lab::melting_lab(dx, {.t_solid = 340.0, .solid = SolidKind::elastic});
  lab.scene.materials[0].stiffness = 1e-12;
  lab.scene.materials.push_back(lab.scene.materials[0]);
  lab.scene.materials[1].name = "rigid wax";
  lab.scene.materials[1].solid = SolidKind::rigid;
  lab.scene.time_step = 2e-4;
  lab.add({.name = "rigid",
           .material = 1,
           .corner = {-0.1, -0.1, -0.1},
           .count = {3, 3, 3},
           .angular_velocity = {5.0, 0.0, 5.0},
           .temperature = constant(cold)});
  lab.add({.name = "drops",
           .corner = {-0.1, -0.1, 0.25},
           .count = {3, 3, 2},
           .phase = Phase::liquid,
           .temperature = constant(345.0)});
  Event cool = heat(0.2, 300.0);
  lab.scene.events = {cool};
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.2004);
  EXPECT_EQ(lab::living_bodies(s), 2u);
  double bonds_across = 0.0;
  for (std::uint32_t id = 0; id < 27; ++id)
    for (const Bond& bond : s.state().bonds.of(id)) bonds_across += bond.other >= 27 ? 1.0 : 0.0;
  EXPECT_GT(bonds_across, 0.0);
  EXPECT_LT(energy_of_all(s.state()), 1e-4 * young * dx * dx * dx);  // what a step of turning strains
}

/// A bar of 8 x 3 x 3 that swings along itself, and melts or freezes as heat events say.
lab::Lab swinging_bar(double latent_heat = 2e4) {
  lab::Lab lab = lab::melting_lab(dx, {.latent_heat = latent_heat, .solid = SolidKind::elastic});
  lab.scene.materials[0].stiffness = 1e-12;
  lab.scene.time_step = 5e-4;
  lab.add({.name = "bar", .count = {8, 3, 3}, .phase = Phase::elastic, .temperature = constant(cold)});
  lab.scene.bodies[0].temperature->value = hot;
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    lab.initial.velocity[i] = {2.0 * (lab.initial.position[i].x - 0.35), 0.0, 0.0};
  return lab;
}

TEST(Melting, OfAStrainedBarGivesItsEnergyToHeatAndFreezingMakesNoStress) {
  lab::Lab lab = swinging_bar();
  lab.scene.events = {heat(0.03, hot), heat(0.031, 250.0)};
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.0299);
  const Ledger strained = s.ledger();
  const double stored = strained.energy.at("elastic") + strained.energy.at("hourglass");
  EXPECT_GT(stored, 0.02 * strained.energy.at("kinetic"));
  s.advance_to(0.0305);
  const Ledger molten = s.ledger();
  for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 0);
  EXPECT_EQ(molten.energy.at("elastic") + molten.energy.at("hourglass"), 0.0);
  const double released = s.state().accumulated[account::deformation_released];
  EXPECT_NEAR(released / stored, 1.0, 0.02);  // a step of swinging lies between
  EXPECT_NEAR(lab::total_energy(molten) / lab::total_energy(strained), 1.0, 1e-12);
  s.advance_to(0.0311);
  const Ledger frozen = s.ledger();
  for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 1);
  EXPECT_EQ(lab::living_bodies(s), 1u);
  // What one step of motion strains
  EXPECT_LT(frozen.energy.at("elastic") + frozen.energy.at("hourglass"), 1e-3 * stored);
  EXPECT_NEAR(lab::total_energy(frozen) / lab::total_energy(strained), 1.0, 1e-12);
  EXPECT_NEAR(norm(frozen.momentum - strained.momentum), 0.0, 1e-12 * 72.0);
}

TEST(Melting, OfHalfABarLeavesTheBondsOfTheOtherHalf) {
  lab::Lab lab = swinging_bar(0.0);
  lab.scene.events = {heat(0.03, hot, 0.35), heat(0.032, 250.0, 0.0)};
  Simulation s(lab.scene, lab.initial);
  const State before = s.state();
  s.advance_to(0.031);
  const auto phase = lab::integers_by_id(s, field::phase);
  EXPECT_EQ(std::count(phase.begin(), phase.end(), 0), 36);
  std::size_t kept = 0;
  for (std::uint32_t id = 0; id < phase.size(); ++id) {
    for (const Bond& bond : s.state().bonds.of(id)) {
      EXPECT_EQ(phase[id], 1);
      EXPECT_EQ(phase[bond.other], 1);
      const auto old = before.bonds.of(id);
      const auto at = std::ranges::find(old, bond.other, &Bond::other);
      ASSERT_NE(at, old.end());
      EXPECT_EQ(at->x, bond.x);
      ++kept;
    }
  }
  EXPECT_GT(kept, 300u);
  const double stored = energy_of_all(s.state());
  s.advance_to(0.0321);  // frozen again: of two kinds of bonds one body
  EXPECT_EQ(lab::living_bodies(s), 1u);
  EXPECT_NEAR(energy_of_all(s.state()), stored, 0.05 * stored);  // 2 steps of swinging
  const State& now = s.state();
  for (std::uint32_t id = 0; id < phase.size(); ++id) {
    if (phase[id] == 1) continue;
    double strain = 0.0;
    for (const Bond& bond : now.bonds.of(id)) {
      const Vec3 r = now.particles.position(now.particles.row(id)) -
                     now.particles.position(now.particles.row(bond.other));
      strain = std::max(strain, norm(r - bond.x) / dx);
    }
    EXPECT_LT(strain, 0.01);  // moved since by at most a step's way
  }
}

TEST(Melting, OfAMiddleLayerCutsAnElasticBarAndKeepsItsMomenta) {
  lab::Lab lab = swinging_bar(0.0);
  for (std::size_t i = 0; i < lab.initial.size(); ++i) {
    lab.initial.velocity[i] += cross(Vec3{0.0, 0.0, 3.0}, lab.initial.position[i]);
    if (std::abs(lab.initial.position[i].x - 0.3) < 0.01) lab.initial.temperature[i] = hot;
  }
  Simulation start(lab.scene, lab.initial);
  Simulation s = lab.run(0.02);
  EXPECT_EQ(lab::living_bodies(s), 2u);
  EXPECT_NEAR(norm(s.ledger().momentum - start.ledger().momentum), 0.0, 1e-12 * 72.0);
  EXPECT_NEAR(norm(s.ledger().angular_momentum - start.ledger().angular_momentum), 0.0, 1e-12 * 72.0);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(start.ledger()), 1.0, 1e-12);
}

TEST(Softening, TakesStiffnessWithTheLiquidFractionAndClosesTheLedger) {
  for (const bool printed : {false, true}) {
    lab::Lab lab = swinging_bar();
    Material& m = lab.scene.materials[0];
    m.t_solid = 320.0;
    m.t_melt = 360.0;
    if (printed)
      lab.scene.modes[term::phase] = Mode::paper;
    else
      m.softens = true;
    // printed: held half way through the band; else heat for a quarter of the fusion, 20 K worth of L
    lab.scene.events = {heat(0.03, 340.0)};
    lab.initial.temperature.assign(lab.initial.size(), printed ? 300.0 : 365.0);
    Simulation s(lab.scene, lab.initial);
    s.advance_to(printed ? 0.0299 : 1e-3);
    const Ledger before = s.ledger();
    s.advance_to(0.0306);
    const double left = printed ? 0.5 : 0.75;
    for (const double share : lab::by_id(s, field::stiffness_share)) EXPECT_NEAR(share, left, 1e-6);
    for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 1);
    const State& state = s.state();
    State stiff = state;
    for (double& share : stiff.particles[field::stiffness_share]) share = 1.0;
    EXPECT_NEAR(energy_of_all(state) / energy_of_all(stiff), left, 1e-6);
    EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(before), 1.0, 1e-12);
    EXPECT_NE(state.accumulated[account::deformation_released], 0.0);
  }
}

TEST(Softening, LeavesAMaterialAloneThatDoesNotSoften) {
  lab::Lab lab = swinging_bar();
  lab.scene.materials[0].t_solid = 320.0;
  lab.scene.materials[0].t_melt = 360.0;
  lab.scene.materials.push_back(lab.scene.materials[0]);
  lab.scene.materials.back().name = "that softens";
  lab.scene.materials.back().softens = true;
  const Simulation s = lab.run(1e-3);
  for (const double share : lab::by_id(s, field::stiffness_share)) EXPECT_EQ(share, 1.0);
}

TEST(PrintedHeat, ALiquidThatIsSetToATemperatureTakesHeatAndNoFusion) {
  lab::Lab lab = swinging_bar();
  lab.scene.modes[term::heat] = Mode::paper;
  lab.initial.temperature.assign(lab.initial.size(), 420.0);
  lab.scene.events = {heat(0.01, 440.0)};
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.009);
  for (const int phase : lab::integers_by_id(s, field::phase)) EXPECT_EQ(phase, 0);
  const Ledger before = s.ledger();
  s.advance_to(0.0102);
  for (const double temperature : lab::by_id(s, field::temperature)) EXPECT_GT(temperature, 430.0);
  EXPECT_NEAR(lab::total_energy(s.ledger()) / lab::total_energy(before), 1.0, 1e-12);
}

/// Two rigid particles 0.1 m apart that spin by 2 rad/s, of a material of 1e5 Pa that is elastic between 320
/// and 360 K, at these temperatures.
Simulation spinning_pair(double first, double second, bool softens = true) {
  lab::Lab lab = lab::melting_lab(0.1, {.t_melt = 360.0, .t_solid = 320.0, .conductivity = 1e-12});
  lab.scene.modes[term::phase] = Mode::paper;
  lab.scene.merge_distance = 2.12;
  Material& m = lab.scene.materials[0];
  m.young_modulus = 1e5;
  m.poisson_ratio = 0.3;
  m.softens = softens;
  const auto temperature = [=](const Vec3& r) { return r.x < 0.05 ? first : second; };
  lab.add_points({.name = "pair",
                  .phase = Phase::rigid,
                  .angular_velocity = {0.0, 0.0, 2.0},
                  .temperature = temperature},
                 {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}}, 1.0);
  TemperatureField& field = *lab.scene.bodies[0].temperature;
  field.kind = TemperatureField::Kind::step;
  field.behind = first;
  field.ahead = second;
  lab.scene.time_step = 1e-6;
  return lab.run(1e-6);
}

std::vector<int> kinds(const Simulation& s) { return lab::integers_by_id(s, field::phase); }

TEST(PrintedStage, ARigidMaterialThatSoftensIsElasticBetweenItsTwoTemperatures) {
  constexpr int liquid = 0, elastic = 1, rigid = 2;
  EXPECT_EQ(kinds(spinning_pair(319.0, 319.0)), (std::vector{rigid, rigid}));
  EXPECT_EQ(kinds(spinning_pair(330.0, 319.0)), (std::vector{elastic, rigid}));
  EXPECT_EQ(kinds(spinning_pair(330.0, 350.0)), (std::vector{elastic, elastic}));
  EXPECT_EQ(kinds(spinning_pair(361.0, 350.0)), (std::vector{liquid, elastic}));
  EXPECT_EQ(kinds(spinning_pair(330.0, 350.0, false)),
            (std::vector{rigid, rigid}));  // what does not soften is rigid up to t_melt
}

TEST(PrintedStage, WhatTurnsKeepsItsBondsItsMotionAndItsShareOfTheModulus) {
  const Simulation s = spinning_pair(330.0, 350.0);  // a quarter and three quarters of the way
  EXPECT_EQ(lab::living_bodies(s), 1u);
  EXPECT_EQ(count_objects(s.state()), 1u);
  const auto share = lab::by_id(s, field::stiffness_share);
  EXPECT_NEAR(share[0], 0.75, 1e-12);
  EXPECT_NEAR(share[1], 0.25, 1e-12);
  for (const std::uint32_t id : {0U, 1U}) {
    ASSERT_EQ(s.state().bonds.of(id).size(), 1u);
    EXPECT_NEAR(norm(s.state().bonds.of(id)[0].x), 0.1, 1e-9);
  }
  const auto v = lab::speeds(s);  // omega x r: 2 rad/s at 0.05 m
  EXPECT_NEAR(v[0].y, -0.1, 1e-6);
  EXPECT_NEAR(v[1].y, 0.1, 1e-6);
}

TEST(Phase, OfDeformableSolidsGoesOnFromACheckpointBitForBit) {
  lab::Lab lab = swinging_bar(0.0);
  lab.scene.materials[0].stiffness = 100.0;
  lab.scene.events = {heat(0.01, hot, 0.45), heat(0.012, 250.0, 0.0)};
  for (const double cut : {0.0101, 0.0112, 0.0125}) {
    Simulation whole(lab.scene, lab.initial), first(lab.scene, lab.initial);
    whole.advance_to(cut);
    whole.advance_to(0.02);
    first.advance_to(cut);
    const Checkpoint kept = first.checkpoint();
    Simulation second(lab.scene, lab.initial, {}, kept);
    second.advance_to(0.02);
    EXPECT_EQ(lab::places(second), lab::places(whole));
    EXPECT_EQ(lab::by_id(second, field::enthalpy), lab::by_id(whole, field::enthalpy));
    EXPECT_EQ(second.ledger().energy, whole.ledger().energy);
  }
}

TEST(Phase, OfDeformableSolidsDoesNotDependOnTheOrderOfParticlesOrOnThreads) {
  lab::Lab lab = swinging_bar(0.0);
  lab.scene.materials[0].stiffness = 100.0;
  lab.scene.events = {heat(0.01, hot, 0.45), heat(0.012, 250.0, 0.0)};
  for (std::size_t i = 0; i < lab.initial.size(); i += 7) lab.initial.temperature[i] = hot;
  Simulation s = lab.run(0.02), threaded = lab.run(0.02, 2);
  EXPECT_EQ(lab::places(s), lab::places(threaded));
  EXPECT_EQ(s.ledger().energy, threaded.ledger().energy);
  lab::Lab other = lab;
  const std::vector<std::size_t> now = lab::shuffle(other, 5);
  const Simulation t = other.run(0.02);
  const std::vector<Vec3> x = lab::places(s), z = lab::places(t);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(norm(z[now[i]] - x[i]), 0.0, 1e-11);
  EXPECT_EQ(lab::living_bodies(s), lab::living_bodies(t));
}

}  // namespace
}  // namespace tripoint
