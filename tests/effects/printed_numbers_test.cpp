// SPDX-License-Identifier: BSD-3-Clause
// The printed equations on two, three and four particles, with numbers worked out on paper. The support
// radius is 2 m and neighbours are 1 m apart: poly6 is 315/(512 pi) at 0, 8505/(32768 pi) at 1 and
// 2520/(32768 pi) at sqrt 2; spiky' is -45/(64 pi) at 1; the viscosity kernel's Laplacian 45/(64 pi).
#include <gtest/gtest.h>

#include <numbers>

#include "effects/fluid_lab.hpp"
#include "liquids/fields.hpp"

namespace tripoint {
namespace {

constexpr double pi = std::numbers::pi, mass = 2.0, k = 100.0, mu = 3.0;
constexpr double at_0 = 315.0 / (512.0 * pi), at_1 = 8505.0 / (32768.0 * pi),
                 at_root_2 = 2520.0 / (32768.0 * pi);
// Of spiky at 1, towards the particle, and of the Laplacian at 1
constexpr double spiky_slope = 45.0 / (64.0 * pi);

/// Liquid particles of 2 kg at these places, as printed in every term, rest density 2 kg/m3.
lab::Lab printed(const std::vector<Vec3>& places, bool heat = false) {
  lab::Lab lab = lab::liquid_lab(1.0, 2.0, mu, k, Mode::paper);
  lab.scene.support_ratio = 2.0;
  lab.scene.materials[0].conductivity = 10.0;
  lab.scene.materials[0].heat_capacity = 1.0;  // c = 10/(2 1) = 5 m2/s
  lab::Block block{.phase = Phase::liquid};
  if (heat) block.temperature = [](const Vec3& r) { return 300.0 + 10.0 * r.x; };
  lab.add_points(block, places, mass);
  return lab;
}

Vec3 force(const Simulation& s, std::size_t id) {
  const Particles& p = s.state().particles;
  return p.vector(p.row(static_cast<std::uint32_t>(id)), field::force);
}

Vec3 viscous(const Simulation& s, std::size_t id) {
  const Particles& p = s.state().particles;
  return p.vector(p.row(static_cast<std::uint32_t>(id)), field::viscous_force);
}

TEST(PrintedNumbers, TwoParticlesHaveTheDensityPressureAndForcesOfPaper) {
  lab::Lab lab = printed({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  lab.initial.velocity[1] = {0.0, 4.0, 0.0};
  lab.scene.time_step = 1e-9;
  // Nothing has moved yet, and viscosity has its first velocities
  const Simulation s = lab.run(1e-9);
  const double rho = mass * (at_0 + at_1);             // (4), 0.5569
  const double p = k * (rho - 2.0);                    // (9), -144.3: no clamp
  const double V = mass / rho;                         // 3.591
  const double pull = -V * V * p * spiky_slope;        // (7), 416.56 N: negative pressure pulls
  const double drag = V * V * mu * 4.0 * spiky_slope;  // (8), 34.64 N
  EXPECT_NEAR(rho, 0.55691, 1e-5);
  EXPECT_NEAR(p, -144.309, 1e-3);
  EXPECT_NEAR(pull, 416.556, 1e-3);
  EXPECT_NEAR(drag, 34.6385, 1e-4);
  for (const std::size_t id : {0U, 1U}) {
    EXPECT_NEAR(lab::by_id(s, field::density)[id], rho, 1e-13);
    EXPECT_NEAR(lab::by_id(s, field::pressure)[id], p, 1e-11);
    const double side = id == 0 ? 1.0 : -1.0;
    EXPECT_NEAR(force(s, id).x, side * pull, 1e-5);
    EXPECT_NEAR(viscous(s, id).y, side * drag, 1e-5);
    EXPECT_NEAR(viscous(s, id).x, 0.0, 1e-5);
    EXPECT_EQ(force(s, id).z, 0.0);
  }
}

TEST(PrintedNumbers, OfThreeInALineTheMiddleOneIsDenserAndFeelsNothing) {
  const lab::Lab lab = printed({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}});
  const Simulation s(lab.scene, lab.initial, {.threads = 1});
  // The ends are 2 m apart: out of reach
  const double end = mass * (at_0 + at_1), middle = mass * (at_0 + 2.0 * at_1);
  EXPECT_NEAR(lab::by_id(s, field::density)[0], end, 1e-13);
  EXPECT_NEAR(lab::by_id(s, field::density)[1], middle, 1e-13);
  EXPECT_NEAR(lab::by_id(s, field::density)[2], end, 1e-13);
  const double mean = 0.5 * (k * (end - 2.0) + k * (middle - 2.0));  // (p_i + p_j)/2 of (7)
  EXPECT_NEAR(force(s, 0).x, -(mass / end) * (mass / middle) * mean * spiky_slope, 1e-10);
  EXPECT_NEAR(force(s, 1).x, 0.0, 1e-10);
  EXPECT_NEAR(force(s, 2).x, -force(s, 0).x, 1e-10);
}

TEST(PrintedNumbers, FourInASquareSeeTheDiagonalToo) {
  const lab::Lab lab = printed({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}});
  const Simulation s(lab.scene, lab.initial, {.threads = 1});
  const double rho = mass * (at_0 + 2.0 * at_1 + at_root_2), p = k * (rho - 2.0), V = mass / rho;
  const double root = std::sqrt(2.0), diagonal = 45.0 * (2.0 - root) * (2.0 - root) / (64.0 * pi);
  for (std::size_t id = 0; id < 4; ++id) EXPECT_NEAR(lab::by_id(s, field::density)[id], rho, 1e-13);
  EXPECT_NEAR(force(s, 0).x, -V * V * p * (spiky_slope + diagonal / root), 1e-10);
  EXPECT_NEAR(force(s, 0).y, force(s, 0).x, 1e-10);
}

TEST(PrintedNumbers, HeatFlowsByTheConstantOfTheMaterialAndByTheOneOfTheScene) {
  for (const double one : {0.0, 7.0}) {
    lab::Lab lab = printed({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}, true);
    lab.scene.values["heat_constant"] = one;
    lab.scene.time_step = 1e-6;
    const Simulation s = lab.run(1e-6);
    const double c = one > 0.0 ? one : 5.0, V_middle = mass / (mass * (at_0 + 2.0 * at_1)),
                 V_end = mass / (mass * (at_0 + at_1));
    const double rate = c * V_middle * 10.0 * spiky_slope;  // (21) at the cold end [K/s]
    const auto T = lab::by_id(s, field::temperature);
    EXPECT_NEAR((T[0] - 300.0) / 1e-6, rate, 1e-5 * rate);
    EXPECT_NEAR((T[1] - 310.0) / 1e-6, 0.0, 1e-4 * rate);  // as much from one side as to the other
    EXPECT_NEAR((T[2] - 320.0) / 1e-6, -rate, 1e-5 * rate);
    EXPECT_GT(V_end, V_middle);
  }
}

/// A liquid particle of 3 Pa s at the origin, which moves by 4 m/s across, and a held solid one of
/// solid_viscosity 12 Pa s beside it, at this temperature.
double drag_at_solid(double temperature, double contact_viscosity) {
  lab::Lab lab = printed({});
  lab.scene.contact_viscosity = contact_viscosity;
  lab.add_material(2.0, 10.0, 1.0);
  Material& solid = lab.scene.materials[1];
  solid.viscosity = 6.0;
  solid.stiffness = k;
  solid.solid = SolidKind::elastic;
  solid.young_modulus = 1.0;
  solid.poisson_ratio = 0.3;
  solid.t_solid = 320.0;
  solid.t_melt = 360.0;
  if (contact_viscosity == 0.0) solid.values["solid_viscosity"] = 12.0;
  const auto at = [=](const Vec3&) { return temperature; };
  lab.add_points({.name = "drop", .phase = Phase::liquid, .temperature = at}, {{0.0, 0.0, 0.0}}, mass);
  lab.add_points(
      {.name = "wall", .material = 1, .phase = Phase::elastic, .motion = Motion::fixed, .temperature = at},
      {{1.0, 0.0, 0.0}}, mass);
  for (Body& body : lab.scene.bodies) body.temperature->value = temperature;
  lab.initial.velocity[0] = {0.0, 4.0, 0.0};
  lab.scene.materials[0].conductivity = 1e-12;
  solid.conductivity = 1e-12;
  lab.scene.time_step = 1e-9;
  return -viscous(lab.run(1e-9), 0).y;
}

TEST(PrintedNumbers, ASolidsOwnViscosityActsAndGoesLinearlyToThatOfTheLiquid) {
  // V = 2/0.55691 = 3.5912 m3; V^2 (mu_i + mu_j)/2 4 m/s 45/(64 pi) = 34.6385 N at a mean of 3 Pa s,
  // so 11.5462 N for each Pa s of it.
  constexpr double per_mean = 11.54617;
  EXPECT_NEAR(drag_at_solid(300.0, 0.0), 7.5 * per_mean, 1e-3);  // (3 + 12)/2
  // a quarter of the way from 12 to 6 is 10.5: (3 + 10.5)/2
  EXPECT_NEAR(drag_at_solid(330.0, 0.0), 6.75 * per_mean, 1e-3);
  EXPECT_NEAR(drag_at_solid(340.0, 0.0), 6.0 * per_mean, 1e-3);  // half way: (3 + 9)/2
  EXPECT_NEAR(drag_at_solid(340.0, 5.0), 4.0 * per_mean,
              1e-3);  // without the key: the scene's contact viscosity, at any temperature
}

TEST(PrintedNumbers, AForceTurnsABodyOfFourByItsLever) {
  lab::Lab lab = printed({});
  lab.add_points({.name = "frame", .phase = Phase::rigid, .angular_velocity = {0.0, 0.0, 0.5}},
                 {{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}, mass);
  lab.scene.time_step = 0.01;
  const Simulation s = lab.run(0.01);
  // I_z = 4 m r^2 = 8 kg m2, so L = 4 kg m2/s; the body turns by omega dt = 0.005 rad (19), (20).
  const Particles& p = s.state().particles;
  EXPECT_NEAR(p.position(p.row(0)).x, std::cos(0.005), 1e-12);
  EXPECT_NEAR(p.position(p.row(0)).y, std::sin(0.005), 1e-12);
}

}  // namespace
}  // namespace tripoint
