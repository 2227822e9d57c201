// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of held temperature (model 8.6).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "effects/lab.hpp"

namespace tripoint {
namespace {

/// A slab of one centimetre between faces held at 300 K, `across` particles thick, periodic along the others.
lab::Lab slab(int across, const std::function<double(const Vec3&)>& temperature) {
  const double dx = 0.01 / across;
  lab::Lab lab(dx);
  const std::array<int, 3> count{across, 3, 3};
  lab.make_periodic({false, true, true}, {0.5 * dx, 0.5 * dx, 0.5 * dx}, count);
  lab.add({.corner = {0.5 * dx, 0.5 * dx, 0.5 * dx},
           .count = count,
           .motion = Motion::fixed,
           .temperature = temperature});
  Body& body = lab.scene.bodies[0];
  body.shape.kind = Shape::Kind::box;
  body.shape.min = {0.0, -1.0, -1.0};
  body.shape.max = {0.01, 1.0, 1.0};
  lab.scene.materials[0].values["surface_temperature"] = 300.0;
  return lab;
}

/// Rate at which half a sine between the faces decays, over the exact one, less 1.
double error_of_rate(int across) {
  const double k = std::numbers::pi / 0.01, time = 0.5 / (lab::diffusivity * k * k);
  const auto sine = [&](const Vec3& r) { return std::sin(k * r.x); };
  const Simulation s = slab(across, [&](const Vec3& r) { return 300.0 + 10.0 * sine(r); }).run(time);
  const auto x = lab::by_id(s, field::position.x), T = lab::by_id(s, field::temperature);
  double sum = 0.0, of_sine = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double wave = std::sin(k * x[i]);
    sum += (T[i] - 300.0) * wave;
    of_sine += wave * wave;
  }
  return -std::log(sum / of_sine / 10.0) / time / (lab::diffusivity * k * k) - 1.0;
}

TEST(HeldSurface, LosesASineBetweenItsFacesAtTheExactRateToSecondOrder) {
  // -1.09 and -0.27 % by the eigenvalue of the sums over the lattice, computed apart from this code; the step
  // adds less than 0.1
  // %.
  EXPECT_NEAR(error_of_rate(10), -0.01087, 1e-3);
  EXPECT_NEAR(error_of_rate(20), -0.00273, 3e-4);
}

TEST(HeldSurface, KeepsAStraightProfileAtRest) {
  // 300 K at one face and 310 K at the other: two bodies of one matter that touch, each with a face of its
  // own.
  const double dx = 1e-3;
  lab::Lab lab(dx);
  lab.add_material(1000.0, 1.0, 1000.0);
  lab.make_periodic({false, true, true}, {0.5 * dx, 0.5 * dx, 0.5 * dx}, {10, 3, 3});
  for (int n = 0; n < 2; ++n) {
    lab.add({.name = n == 0 ? "left" : "right",
             .material = static_cast<std::size_t>(n),
             .corner = {0.5 * dx + 5 * n * dx, 0.5 * dx, 0.5 * dx},
             .count = {5, 3, 3},
             .motion = Motion::fixed,
             .temperature = [](const Vec3& r) { return 300.0 + 1000.0 * r.x; }});
    Body& body = lab.scene.bodies.back();
    body.shape.kind = Shape::Kind::box;
    body.shape.min = {5 * n * dx, -1.0, -1.0};
    body.shape.max = {5 * (n + 1) * dx, 1.0, 1.0};
    lab.scene.materials[static_cast<std::size_t>(n)].values["surface_temperature"] = 300.0 + 10.0 * n;
  }
  const Simulation s = lab.run(1.0);
  const auto x = lab::by_id(s, field::position.x), T = lab::by_id(s, field::temperature);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(T[i], 300.0 + 1000.0 * x[i], 1e-9);
}

TEST(HeldSurface, AccumulatesTheHeatThatComesInThroughIt) {
  const lab::Lab lab = slab(6, [](const Vec3&) { return 350.0; });
  Simulation s(lab.scene, lab.initial);
  const double before = s.ledger().energy.at("thermal");
  s.advance_to(2.0);
  const Ledger after = s.ledger();
  EXPECT_LT(after.energy.at("thermal"), 0.999 * before);
  EXPECT_NEAR((after.energy.at("thermal") + after.energy.at("walls")) / before, 1.0, 1e-12);
  const State& state = s.state();
  EXPECT_NEAR(state.bodies[field::body_heat][0] / (after.energy.at("thermal") - before), 1.0, 1e-9);
}

TEST(HeldSurface, IsAPlaneOfSymmetryWhereTheDomainCutsTheBody) {
  const auto warm = [](const Vec3&) { return 350.0; };
  lab::Lab half = slab(10, warm);
  half.scene.max->x = 0.01;
  const auto T = lab::by_id(half.run(0.5), field::temperature);
  EXPECT_LT(T[0], 340.0);
  EXPECT_GT(T[9], 349.99);
}

TEST(HeldSurface, HoldsItsOutermostParticlesWhereItIsLeftOut) {
  lab::Lab lab = slab(10, [](const Vec3&) { return 350.0; });
  lab.scene.values["surface_exchange"] = 0.0;
  const Simulation s = lab.run(0.5);
  const auto T = lab::by_id(s, field::temperature);
  EXPECT_EQ(T[0], 300.0);
  EXPECT_EQ(T[9], 300.0);
  EXPECT_GT(T[1], 300.0);
}

TEST(HeldSurface, IsRefusedWhereItWouldMoveOrIsPrinted) {
  lab::Lab lab = slab(4, [](const Vec3&) { return 350.0; });
  lab.scene.bodies[0].motion = Motion::free;
  EXPECT_THROW(Simulation(lab.scene, lab.initial), InputError);
  lab.scene.bodies[0].motion = Motion::fixed;
  lab.set_mode(Mode::paper);
  EXPECT_THROW(Simulation(lab.scene, lab.initial), InputError);
}

}  // namespace
}  // namespace tripoint
