// SPDX-License-Identifier: BSD-3-Clause
// Liquid that carries its density beside solids that touch, deform, melt and freeze, and where liquid flows
// in.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "effects/carried_liquid/fields.hpp"
#include "effects/fluid_lab.hpp"
#include "effects/phase_lab.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.1, modulus = 4000.0 * 1000.0;  ///< [m], k rho_ref [Pa]

lab::Lab carried_lab(double viscosity = 1.0) {
  lab::Lab lab = lab::liquid_lab(dx, 1000.0, viscosity, modulus / 1000.0);
  lab.scene.forms[term::pressure] = "adjoint";
  return lab;
}

void make_elastic(Material& m) {
  m.solid = SolidKind::elastic;
  m.young_modulus = 1e6;
  m.poisson_ratio = 0.3;
}

/// Two cubes, the first rigid and the second elastic, that meet head on.
void add_hit(lab::Lab& lab, const Vec3& at, double speed) {
  lab.add({.name = "rigid", .material = 1, .corner = at, .count = {3, 3, 3}, .velocity = {speed, 0.0, 0.0}});
  lab.add({.name = "elastic",
           .material = 1,
           .corner = at + Vec3{3.0 * dx, 0.0, 0.0},
           .count = {3, 3, 3},
           .phase = Phase::elastic,
           .velocity = {-speed, 0.0, 0.0}});
}

/// Liquid with both cubes in it.
lab::Lab wet_hit() {
  lab::Lab lab = carried_lab();
  make_elastic(lab.scene.materials[lab::add_material_like(lab, 1500.0, 0.0)]);
  std::vector<Vec3> liquid;
  for (int n = 0; n < 14 * 9 * 9; ++n) {
    const int x = n % 14, y = n / 14 % 9, z = n / 126;
    if (!(x >= 4 && x < 10 && y >= 3 && y < 6 && z >= 3 && z < 6))
      liquid.push_back(dx * Vec3{double(x), double(y), double(z)});
  }
  lab.add_points({.name = "water", .phase = Phase::liquid}, liquid, 1000.0 * dx * dx * dx);
  add_hit(lab, {4.0 * dx, 3.0 * dx, 3.0 * dx}, 0.5);
  return lab;
}

double mechanical(const Ledger& ledger) {
  double sum = 0.0;
  for (const char* entry : {"kinetic", "compression", "elastic", "hourglass"}) sum += ledger.energy.at(entry);
  return sum;
}

TEST(CarriedSolids, TouchWithTheBitsThatTheyHaveWithoutTheForm) {
  const auto end = [](bool carried) {
    lab::Lab lab = carried_lab();
    if (!carried) lab.scene.forms.clear();
    lab.scene.time_step = 5e-5;
    make_elastic(lab.scene.materials[lab::add_material_like(lab, 1500.0, 0.0)]);
    add_hit(lab, {}, 0.5);
    lab.add({.name = "far", .corner = {5.0, 5.0, 5.0}, .count = {3, 3, 3}, .phase = Phase::liquid});
    std::vector<Vec3> at = lab::positions_by_id(lab.run(0.02));
    at.resize(54);
    return at;
  };
  const std::vector<Vec3> before = end(false), now = end(true);
  EXPECT_EQ(std::memcmp(before.data(), now.data(), before.size() * sizeof(Vec3)), 0);
  EXPECT_GT(norm(now[53] - now[26]), 0.0);
}

TEST(CarriedSolids, KeepMomentumAndTheLedgerInLiquid) {
  lab::Lab lab = wet_hit();
  lab.scene.time_step = 1e-4;  // what finite steps leave falls with its square
  Simulation s(lab.scene, lab.initial);
  const Ledger before = s.ledger();
  s.advance_to(0.03);
  const Ledger after = s.ledger();
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-12 * 1500.0 * 27e-3 * 0.5);
  // The shift moves liquid and leaves its velocity: 4e-9
  EXPECT_LT(norm(after.angular_momentum - before.angular_momentum), 1e-8 * 1500.0 * 27e-3 * 0.5);
  EXPECT_NEAR(lab::total_energy(after), lab::total_energy(before), 1e-11 * lab::total_energy(before));
  EXPECT_GT(after.energy.at("elastic"), 0.01 * mechanical(before));  // they have met
  EXPECT_LT(mechanical(after), mechanical(before));
  EXPECT_LT(std::abs(after.energy.at("time_integration")), 3e-3 * mechanical(before));
}

/// A float of half the density lies in a pool, and covers the liquid beneath it.
TEST(CarriedSolids, CoverLiquidThatStartsAtTheHeadBesideThem) {
  lab::Lab lab = carried_lab();
  lab.scene.gravity = {0.0, 0.0, -10.0};
  lab::add_material_like(lab, 500.0, 0.0);
  std::vector<Vec3> liquid;
  for (int n = 0; n < 10 * 10 * 8; ++n) {
    const int x = n % 10, y = n / 10 % 10, z = n / 100;
    if (!(z >= 6 && x >= 3 && x < 7 && y >= 3 && y < 7))
      liquid.push_back(dx * Vec3{double(x), double(y), double(z)});
  }
  lab.add_points({.name = "water", .phase = Phase::liquid}, liquid, 1000.0 * dx * dx * dx);
  lab.add({.name = "float", .material = 1, .corner = {3.0 * dx, 3.0 * dx, 6.0 * dx}, .count = {4, 4, 4}});
  lab.add({.name = "floor", .corner = {0.0, 0.0, -3.0 * dx}, .count = {10, 10, 3}, .motion = Motion::fixed});
  lab.make_periodic({true, true, false}, {}, {10, 10, 30});
  const Simulation s(lab.scene, lab.initial);
  const auto rho = lab::by_id(s, field::density);
  const auto at = lab::positions_by_id(s);
  for (std::size_t i = 0; i < liquid.size(); ++i)
    EXPECT_NEAR(modulus * (rho[i] / 1000.0 - 1.0), 1000.0 * 10.0 * (7.5 * dx - at[i].z), 1.0);
}

/// A hot block of rigid matter in a cold pool of its melt; it melts, or the pool freezes.
lab::Lab pool_and_block(double pool, double block) {
  lab::Lab lab = carried_lab(10.0);
  lab.scene.gravity = {0.0, 0.0, -10.0};
  Material& m = lab.scene.materials[0];
  m.conductivity = 1e-9;
  m.heat_capacity = 1000.0;
  m.t_melt = m.t_solid = 350.0;
  m.latent_heat = 0.0;
  lab.add_material(1000.0, 1e-9, 1000.0);
  std::vector<Vec3> liquid;
  for (int n = 0; n < 6 * 6 * 8; ++n) {
    const int x = n % 6, y = n / 6 % 6, z = n / 36;
    if (!(z >= 2 && z < 4 && x >= 2 && x < 4 && y >= 2 && y < 4))
      liquid.push_back(dx * Vec3{double(x), double(y), double(z)});
  }
  lab.add_points({.name = "pool", .phase = Phase::liquid, .temperature = lab::constant(pool)}, liquid,
                 1000.0 * dx * dx * dx);
  lab.add({.name = "block",
           .corner = {2.0 * dx, 2.0 * dx, 2.0 * dx},
           .count = {2, 2, 2},
           .temperature = lab::constant(block)});
  lab.add({.name = "floor",
           .material = 1,
           .corner = {0.0, 0.0, -3.0 * dx},
           .count = {6, 6, 3},
           .motion = Motion::fixed,
           .temperature = lab::constant(1.01 * pool)});
  lab.scene.bodies[0].temperature->value = pool;  // what the scene is asked by
  lab.scene.bodies[1].temperature->value = block;
  lab.make_periodic({true, true, false}, {}, {6, 6, 30});
  return lab;
}

TEST(CarriedPhase, WhatMeltsTakesThePressureAroundIt) {
  lab::Lab lab = pool_and_block(lab::hot, lab::hot);
  lab.scene.time_step = 1e-5;
  const Simulation s = lab.run(3e-5);
  const auto rho = lab::by_id(s, field::density);
  const auto body = lab::integers_by_id(s, field::body);
  for (std::size_t i = 280; i < 288; ++i) {
    EXPECT_EQ(body[i], -1);
    const double height = i < 284 ? 2.0 : 3.0, exact = 1000.0 * 10.0 * (7.5 - height) * dx;
    EXPECT_NEAR(modulus * (rho[i] / 1000.0 - 1.0), exact, 0.03 * exact);
  }
}

TEST(CarriedPhase, AccumulatesTheCompressionThatComesAndGoes) {
  for (const bool melts : {true, false}) {
    lab::Lab lab = melts ? pool_and_block(lab::hot, lab::hot) : pool_and_block(lab::cold, lab::cold);
    Simulation s(lab.scene, lab.initial);
    s.advance_to(0.02);
    const double before = lab::total_energy(s.ledger());
    s.advance_to(0.05);
    EXPECT_NEAR(lab::total_energy(s.ledger()), before, 1e-12 * std::abs(before));
    EXPECT_LT(std::abs(s.ledger().energy.at("time_integration")), 0.5);
  }
}

lab::Lab all_at_once() {
  lab::Lab lab = pool_and_block(lab::hot, lab::cold);
  lab.scene.materials[0].conductivity = 2e4;
  Inflow in;
  in.material = lab.scene.materials[0].name;
  in.shape.min = {0.05, 0.05, 1.5};
  in.shape.max = {0.35, 0.35, 1.7};
  in.velocity = {0.0, 0.0, -4.0};
  in.temperature = lab::hot;
  in.stop = 0.1;
  lab.scene.inflows.push_back(in);
  make_elastic(lab.scene.materials[lab::add_material_like(lab, 900.0, 0.0)]);
  lab.scene.materials.back().t_melt.reset();
  lab.add({.name = "pad",
           .material = 2,
           .corner = {0.0, 0.0, 8.0 * dx},
           .count = {3, 3, 3},
           .phase = Phase::elastic,
           .temperature = lab::constant(lab::hot)});
  lab.scene.end_time = 0.08;
  return lab;
}

TEST(CarriedPhase, HasTheSameBitsOnAnyThreadsAndFromACheckpoint) {
  const lab::Lab lab = all_at_once();
  const Simulation one = lab.run(0.08);
  const Simulation three = lab.run(0.08, 3);
  const auto a = lab::positions_by_id(one), b = lab::positions_by_id(three);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), lab.initial.size());  // something flowed in
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
  Simulation first = lab.run(0.04);
  Simulation second(lab.scene, lab.initial, {}, first.checkpoint());
  first.advance_to(0.08);
  second.advance_to(0.08);
  const Checkpoint x = first.checkpoint(), y = second.checkpoint();
  for (const auto& [name, values] : x.real)
    EXPECT_EQ(std::memcmp(values.data(), y.real.at(name).data(), values.size() * sizeof(double)), 0) << name;
}

TEST(CarriedPhase, LiquidThatFlowsInBringsItsEnergy) {
  const lab::Lab lab = all_at_once();
  Simulation s(lab.scene, lab.initial);
  const double before = lab::total_energy(s.ledger());
  s.advance_to(0.08);
  EXPECT_NEAR(lab::total_energy(s.ledger()), before, 1e-12 * std::abs(before));
}

}  // namespace
}  // namespace tripoint
