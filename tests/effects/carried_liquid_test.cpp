// SPDX-License-Identifier: BSD-3-Clause
// The liquid that carries its density: what its pair forms keep by construction, and that runs have the same
// bits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "effects/carried_liquid/fields.hpp"
#include "effects/carried_liquid/sound_terms.hpp"
#include "effects/fluid_lab.hpp"
#include "pairs/alone.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

constexpr std::array words{"adjoint", "reverse_riemann", "mean", "adjoint_limited", "reverse"};
constexpr int forms = words.size();
bool is_adjoint(int form) { return form != 2; }
bool keeps_spin(int form) { return form == 1 || form == 4; }

lab::Lab blob(int form, double gravity = 0.0) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 1.0, 100.0);
  lab.scene.forms[term::pressure] = words.at(static_cast<std::size_t>(form - 1));
  lab.scene.gravity = {0.0, 0.0, -gravity};
  lab.add({.name = "water", .corner = {0.05, 0.05, 0.05}, .count = {8, 7, 6}, .phase = Phase::liquid});
  lab::jitter(lab, 0.1);
  return lab;
}

/// Stretched in one direction and pressed in the others, and turned.
Vec3 strain(const Vec3& r) {
  return {r.x - 0.5 * r.y, 0.4 * r.x - 0.7 * r.y + 0.2 * r.z, -0.3 * r.z - 0.2 * r.y};
}

/// A column that presses on a floor; what is near the floor does not move.
lab::Lab pressed(int form) {
  lab::Lab lab = lab::column(12, 5, 0.0, 4000.0, 9.81);
  lab.scene.forms[term::pressure] = words.at(static_cast<std::size_t>(form - 1));
  lab::jitter(lab, 0.1);
  lab::set_velocity(lab, [](const Vec3& r) {
    return r.z < 0.35 ? Vec3{} : Vec3{std::sin(9.0 * r.z), std::cos(7.0 * r.z), std::sin(11.0 * r.z)};
  });
  return lab;
}

class Forms : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(CarriedLiquid, Forms, testing::Range(1, forms + 1));

/// A sum that is asked for and never formed would be 0 without a word.
TEST(CarriedLiquid, ATermWithoutAPassOfItsOwnIsAnError) {
  const lab::Lab lab = blob(1);
  const Simulation s(lab.scene, lab.initial);
  EXPECT_TRUE(alone_pass(s.state(), pair_term<carried_liquid::SoundRate>).run);
  EXPECT_THROW(static_cast<void>(alone_pass(s.state(), pair_term<carried_liquid::Moments>)),
               std::logic_error);
}

TEST_P(Forms, KeepMomentumToRoundOff) {
  lab::Lab lab = blob(GetParam());
  lab::set_velocity(lab, [](const Vec3& r) {
    return Vec3{0.3, 0.1, 0.0} - strain(r - Vec3{0.4, 0.35, 0.3});
  });
  Simulation s(lab.scene, lab.initial);
  const Vec3 before = s.ledger().momentum;
  s.advance_to(0.1);
  EXPECT_GT(s.steps(), 10);
  EXPECT_LT(norm(s.ledger().momentum - before), 1e-12 * norm(before));
}

/// Between renewals too forces are opposite and turn nothing. The gradients are held, the corrections are
/// not.
TEST(CarriedLiquid, HoldsGradientsForThreeSteps) {
  lab::Lab lab = blob(1);
  lab.scene.time_step = 1e-3;
  lab::set_velocity(lab, [](const Vec3& r) {
    return Vec3{0.3, 0.1, 0.0} - strain(r - Vec3{0.4, 0.35, 0.3});
  });
  Simulation s(lab.scene, lab.initial);
  const Vec3 before = s.ledger().momentum;
  const auto of_five = [&](const Field<double>& f) {
    return s.state().particles[f][s.state().particles.row(5)];
  };
  std::vector<double> B{of_five(field::correction.xy)}, e{of_five(field::strain_rate.xy)};
  for (int step = 1; step <= 4; ++step) {
    s.advance_to(1e-3 * step);
    B.push_back(of_five(field::correction.xy));
    e.push_back(of_five(field::strain_rate.xy));
    EXPECT_LT(norm(s.ledger().momentum - before), 1e-13 * norm(before)) << step;
    Vec3 sum, torque;
    double size = 0.0;
    const Particles& p = s.state().particles;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 F =
          p.vector(i, field::force) + p.vector(i, field::viscous_force) + p.vector(i, field::residue_force);
      sum += F;
      torque += cross(p.vector(i, field::position), F);
      size += norm(F);
    }
    EXPECT_LT(norm(sum), 1e-13 * size) << step;
    EXPECT_LT(norm(torque), 1e-13 * size) << step;
  }
  EXPECT_EQ(e[1], e[2]);
  EXPECT_NE(e[2], e[3]);
  EXPECT_NE(B[1], B[2]);
}

/// sum F.v = sum p dV/dt, whatever the velocities.
TEST_P(Forms, ForceIsTheAdjointOfTheRateOfDensity) {
  const lab::Lab lab = pressed(GetParam());
  const Simulation s(lab.scene, lab.initial);
  const Particles& p = s.state().particles;
  double force = 0.0, rate = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[field::body][i] >= 0) continue;
    force += dot(p.vector(i, field::force), velocities(p).at(i));
    rate += p[field::pressure][i] * p[field::volume][i] * p[field::divergence][i];
  }
  EXPECT_GT(std::abs(rate), 1.0);
  if (is_adjoint(GetParam())) {
    EXPECT_NEAR(force, rate, 1e-11 * std::abs(rate));
  } else {
    EXPECT_GT(std::abs(force - rate), 1e-3 * std::abs(rate));
  }
}

TEST_P(Forms, KeepSpinWhereThePairIsTheOwnOne) {
  lab::Lab lab = blob(GetParam());
  lab.scene.materials[0].viscosity = 0.0;
  lab::set_velocity(lab, [](const Vec3& r) { return -1.0 * strain(r - Vec3{0.4, 0.35, 0.3}); });
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.05);
  const Particles& p = s.state().particles;
  Vec3 torque;
  double size = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 F = p.vector(i, field::force), r = p.position(i);
    torque += cross(r, F);
    size += norm(r) * norm(F);
  }
  ASSERT_GT(size, 1.0);
  if (keeps_spin(GetParam())) {
    EXPECT_LT(norm(torque), 1e-11 * size);
  }
}

TEST(CarriedLiquid, RateIsExactForLinearVelocities) {
  lab::Lab lab = blob(1);
  lab::set_velocity(lab, strain);
  const Simulation s(lab.scene, lab.initial);
  const Particles& p = s.state().particles;
  int inside = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto r = p.position(i) - Vec3{0.4, 0.35, 0.3};
    if (std::max({std::abs(r.x) - 0.15, std::abs(r.y) - 0.1, std::abs(r.z) - 0.05}) > 0.0) continue;
    EXPECT_NEAR(p[field::divergence][i], 1.0 - 0.7 - 0.3, 1e-12);
    EXPECT_NEAR(p[field::velocity_gradient.xy][i], -0.5, 1e-12);
    EXPECT_NEAR(p[field::velocity_gradient.zz][i], -0.3, 1e-12);
    ++inside;
  }
  EXPECT_GT(inside, 4);
}

/// A step without forces along the velocities of a turn spreads places by 1 + (omega dt)^2, and the density
/// follows. What is held leaves 1 % of it.
TEST(CarriedLiquid, DensityFollowsAStepExactly) {
  lab::Lab lab = blob(4);
  lab.scene.materials[0].viscosity = 0.0;
  const double omega = 20.0;
  lab.scene.time_step = 1e-3;
  lab::set_velocity(lab, [&](const Vec3& r) { return omega * Vec3{-(r.y - 0.35), r.x - 0.4, 0.0}; });
  Simulation s(lab.scene, lab.initial);
  s.advance_to(1e-3);
  const Particles& p = s.state().particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto r = p.position(i) - Vec3{0.4, 0.35, 0.3};
    if (std::max({std::abs(r.x) - 0.1, std::abs(r.y) - 0.1, std::abs(r.z) - 0.05}) > 0.0) continue;
    // Without the higher orders it stays 1
    EXPECT_NEAR(p[field::density][i] / 1000.0, 1.0 / (1.0 + 4e-4), 1e-5);
  }
}

TEST_P(Forms, FallFreely) {
  lab::Lab lab = blob(GetParam(), 9.81);
  for (auto& r : lab.initial.position)
    r = {0.1 * std::round(r.x / 0.1 - 0.5), 0.1 * std::round(r.y / 0.1 - 0.5),
         0.1 * std::round(r.z / 0.1 - 0.5)};
  const auto before = lab.initial.position;
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.3);
  const auto now = lab::positions_by_id(s);
  for (std::size_t i = 0; i < now.size(); ++i)
    EXPECT_LT(norm(now[i] - before[i] - Vec3{0.0, 0.0, -0.5 * 9.81 * 0.09}), 1e-6);
}

TEST_P(Forms, HaveTheSameBitsOnAnyThreads) {
  const lab::Lab lab = pressed(GetParam());
  const auto end = [&](int threads) {
    Simulation s(lab.scene, lab.initial, {.threads = threads});
    s.advance_to(0.02);
    return lab::positions_by_id(s);
  };
  const auto one = end(1), three = end(3);
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(Vec3)), 0);
}

TEST_P(Forms, GoOnFromACheckpointWithTheSameBits) {
  const lab::Lab lab = pressed(GetParam());
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.01);
  s.advance_to(0.02, [&] {
    return s.state().step_numbers[StepNumber{"carried_steps_held", 0.0}] != 1.0 && GetParam() == 1;
  });
  const Checkpoint cut = s.checkpoint();
  s.advance_to(0.02);
  Simulation again(lab.scene, lab.initial, {}, cut);
  again.advance_to(0.02);
  const Checkpoint a = s.checkpoint(), b = again.checkpoint();
  for (const auto& [name, values] : a.real) {
    ASSERT_TRUE(b.real.count(name)) << name;
    EXPECT_EQ(std::memcmp(values.data(), b.real.at(name).data(), values.size() * sizeof(double)), 0) << name;
  }
}

}  // namespace
}  // namespace tripoint
