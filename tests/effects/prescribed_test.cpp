// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "effects/lab.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.01, speed = 0.5;

/// A jet of 4 x 4 particles that enters along -z, two spacings deep, at 0.5 m/s from 0 to 0.1 s.
lab::Lab jet() {
  lab::Lab lab(dx);
  lab.scene.materials[0].stiffness = 400.0;
  lab.scene.materials[0].viscosity = 1.0;
  Inflow in;
  in.material = lab.scene.materials[0].name;
  in.shape.min = {-0.02, -0.02, 0.1};
  in.shape.max = {0.02, 0.02, 0.12};
  in.velocity = {0.0, 0.0, -speed};
  in.temperature = 300.0;
  in.stop = 0.1;
  lab.scene.inflows.push_back(in);
  lab.add(
      {.corner = {0.5, 0.5, 0.5}, .phase = Phase::liquid, .temperature = [](const Vec3&) { return 300.0; }});
  return lab;
}

TEST(Inflow, BringsALayerASpacingInStepWithItsSpeed) {
  Simulation s = jet().run(0.1);
  EXPECT_EQ(s.state().particles.size(), 1u + 16u * 6u);  // layers begin at 0, dx/v, ..., 5 dx/v = 0.1 s
  EXPECT_NEAR(s.ledger().mass, 97.0 * 1e-3, 1e-15);      // rho dx^3 each
}

/// The jet ten times lighter, or heavier, than the one body there is.
lab::Lab jet_of(double density) {
  lab::Lab lab = jet();
  lab.scene.materials[0].viscosity = 0.0;  // leaves the bound to sound
  Material other = lab.scene.materials[0];
  other.name = "jet";
  other.density = density;
  lab.scene.materials.push_back(other);
  lab.scene.inflows[0].material = other.name;
  lab.scene.inflows[0].velocity = {0.0, 0.0, -1e-8 * speed};  // the bound counts it beside sound
  return lab;
}

/// Sound is fastest where it is lightest: sqrt(10) times as fast here, in a liquid that no body is made of.
TEST(Inflow, SetsTheStepOfSoundWhereItIsLighterThanEveryBody) {
  const auto bound = [](double density) {
    const lab::Lab lab = jet_of(density);
    return Simulation(lab.scene, lab.initial).bound();
  };
  const double denser = jet().scene.materials[0].density;
  EXPECT_EQ(bound(0.1 * denser).name, "sound");
  EXPECT_NEAR(bound(denser).dt / bound(0.1 * denser).dt, std::sqrt(10.0), 1e-6);
  EXPECT_NEAR(bound(denser).dt / bound(10.0 * denser).dt, std::sqrt(10.0),
              1e-6);  // the heavy liquid has the stated speed of sound, the light one more
}

TEST(Inflow, IsALatticeWhereItEnters) {
  const Simulation s = jet().run(0.09);
  const Particles& p = s.state().particles;
  double nearest = 1.0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, norm(p.position(i) - p.position(j)));
  EXPECT_NEAR(nearest, dx, 1e-9 * dx);  // nothing acts on a lattice at rest density but round-off
}

TEST(Inflow, IsAccumulatedSoThatTheLedgerCloses) {
  lab::Lab lab = jet();
  lab.scene.gravity = {0.0, 0.0, -9.81};
  Simulation s(lab.scene, lab.initial);
  const auto total = [&] {
    double sum = 0.0;
    for (const auto& [term, energy] : s.ledger().energy) sum += energy;
    return sum;
  };
  const double before = total();
  s.advance_to(0.2);
  EXPECT_NEAR(total(), before, 1e-9 * 97.0 * 300.0);  // round-off of m c_p T of all that came
}

TEST(Inflow, GoesOnBitForBitFromACheckpointAndOnTwoThreads) {
  const lab::Lab lab = jet();
  const Simulation whole = lab.run(0.15, 2);
  Simulation first(lab.scene, lab.initial);
  first.advance_to(0.15, [&] { return first.steps() < 30; });
  Simulation second(lab.scene, lab.initial, {.threads = 1}, first.checkpoint());
  second.advance_to(0.15);
  EXPECT_EQ(lab::by_id(whole, field::position.z), lab::by_id(second, field::position.z));
  EXPECT_EQ(lab::by_id(whole, field::velocity.x), lab::by_id(second, field::velocity.x));
}

Event event(Event::Kind kind, double time, double until) {
  Event e;
  e.kind = kind;
  e.time = time;
  e.until = until;
  return e;
}

TEST(Grip, CarriesARigidBodyAsItsKeyframesSayAndLetsItFlyOn) {
  lab::Lab lab(dx);
  lab.add({.corner = {0.1, 0.0, 0.0}, .count = {3, 3, 3}});
  Event grip = event(Event::Kind::grip, 0.2, 0.6);
  grip.region.emplace();
  grip.region->min = {-1.0, -1.0, -1.0};
  grip.region->max = {1.0, 1.0, 1.0};
  const double angle = 0.5;  // [rad], about z in 0.4 s
  grip.keyframes = {{0.2, {}, {}},
                    {0.6, {0.0, 0.0, 0.2}, {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)}}};
  lab.scene.events.push_back(grip);
  const auto centre_at = [&](double t) { return lab.run(t).state().bodies[field::body_centre][0]; };
  const Vec3 start{0.11, 0.01, 0.01};
  const auto turned = [&](double a) {
    return Vec3{start.x * std::cos(a) - start.y * std::sin(a), start.x * std::sin(a) + start.y * std::cos(a),
                start.z};
  };
  EXPECT_LT(norm(centre_at(0.2) - start), 1e-12);
  EXPECT_LT(norm(centre_at(0.4) - (turned(0.25) + Vec3{0.0, 0.0, 0.1})), 1e-12);
  const Vec3 end = turned(angle) + Vec3{0.0, 0.0, 0.2};
  EXPECT_LT(norm(centre_at(0.6) - end), 1e-12);
  const Vec3 velocity = Vec3{-angle / 0.4 * end.y, angle / 0.4 * end.x, 0.5};
  EXPECT_LT(norm(centre_at(0.8) - (end + 0.2 * velocity)), 1e-9);
}

TEST(Hold, StopsALiquidWhereItIsAndLetsItGo) {
  lab::Lab lab(dx);
  lab.scene.materials[0].stiffness = 400.0;
  lab.scene.gravity = {0.0, 0.0, -10.0};
  lab.add({.name = "drop", .corner = {}, .count = {3, 3, 3}, .phase = Phase::liquid});
  Event hold = event(Event::Kind::hold, 0.1, 0.3);
  hold.bodies = {"drop"};
  lab.scene.events.push_back(hold);
  const auto height = [&](double t) {
    const std::vector<double> z = lab::by_id(lab.run(t), field::position.z);
    double sum = 0.0;
    for (const double value : z) sum += value / 27.0;
    return sum;
  };
  const double held = height(0.1);
  EXPECT_NEAR(held, 0.01 - 0.05, 1e-9);         // falls freely for 0.1 s
  EXPECT_EQ(height(0.3), held);                 // not a bit
  EXPECT_NEAR(height(0.4), held - 0.05, 1e-9);  // and falls again from rest
}

}  // namespace
}  // namespace tripoint
