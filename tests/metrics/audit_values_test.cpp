// SPDX-License-Identifier: BSD-3-Clause
// Values that are no values: each is refused by name before a metric sees it.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "fakes.hpp"
#include "validation/audit/audit.hpp"

namespace tripoint {
namespace {

using namespace test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

/// What the audit says of a flight whose frame in the middle is changed.
std::string flight_with(const std::function<void(Snapshot&)>& change,
                        const std::string& precision = "double") {
  Trial t(thrown_block(), "ballistic");
  t.s.job.scene.materials = {Material{}};
  for (auto& frame : t.run.frames) frame.bodies.at(0).mass = 1.0;
  change(t.run.frames.at(5));
  Readback held;
  held.precision = precision;
  return audit(t.s.job, t.s.initial, t.run, held);
}

void expect_refused(const std::string& words, const std::function<void(Snapshot&)>& change) {
  const auto why = flight_with(change);
  EXPECT_NE(why.find(words), std::string::npos) << "\"" << why << "\" has no \"" << words << "\"";
  EXPECT_NE(why.find("t = 0.5"), std::string::npos) << why;
}

TEST(AuditOfValues, LetsAFlightPass) {
  EXPECT_EQ(flight_with([](Snapshot&) {}), "");
}

TEST(AuditOfValues, AnOrientationIsAUnitQuaternion) {
  expect_refused("orientation of `block` is no unit quaternion: (0, 0, 0, 0)", [](Snapshot& s) {
    s.bodies[0].orientation = {0, 0, 0, 0};
  });
  expect_refused("no unit quaternion", [](Snapshot& s) { s.bodies[0].orientation.w = nan; });
  expect_refused("no unit quaternion", [](Snapshot& s) { s.bodies[0].orientation.x += 0.1; });
}

/// Its norm may be off by what an engine's own precision rounds.
TEST(AuditOfValues, TheNormOfAQuaternionIsKnownToTheEnginesPrecision) {
  const auto longer = [](double by) {
    return [by](Snapshot& s) {
      auto& q = s.bodies[0].orientation;
      q = {q.w * (1.0 + by), q.x * (1.0 + by), q.y * (1.0 + by), q.z * (1.0 + by)};
    };
  };
  EXPECT_EQ(flight_with(longer(0.5e-6)), "");
  EXPECT_NE(flight_with(longer(2e-6)).find("no unit quaternion"), std::string::npos);
  EXPECT_EQ(flight_with(longer(0.5e-4), "single"), "");
  EXPECT_NE(flight_with(longer(2e-4), "single").find("no unit quaternion"), std::string::npos);
}

TEST(AuditOfValues, RatesAndPlacesOfABodyAreFinite) {
  expect_refused("angular velocity of `block` is not finite",
                 [](Snapshot& s) { s.bodies[0].angular_velocity.z = infinite; });
  expect_refused("velocity of `block` is not finite", [](Snapshot& s) { s.bodies[0].velocity.x = nan; });
  expect_refused("position of `block` is not finite", [](Snapshot& s) { s.bodies[0].position.y = nan; });
}

TEST(AuditOfValues, MassesAndDensitiesArePositive) {
  expect_refused("mass of `block` is not positive: -1", [](Snapshot& s) { s.bodies[0].mass = -1.0; });
  expect_refused("mass of `block` is not positive: nan", [](Snapshot& s) { s.bodies[0].mass = nan; });
  expect_refused("density of particle 3 is not positive: 0", [](Snapshot& s) {
    s.density.assign(s.position.size(), 1000.0);
    s.density[3] = 0.0;
  });
}

TEST(AuditOfValues, AShareOfLiquidIsWithinZeroToOne) {
  expect_refused("liquid_fraction of particle 0 is not in 0 to 1: 1.01",
                 [](Snapshot& s) { s.liquid_fraction.assign(s.position.size(), 1.01); });
  expect_refused("liquid_fraction of particle 0 is not finite",
                 [](Snapshot& s) { s.liquid_fraction.assign(s.position.size(), nan); });
}

TEST(AuditOfValues, CodesAreInTheirRange) {
  expect_refused("phase of particle 7 is none of 0, 1, 2: 3", [](Snapshot& s) { s.phase[7] = 3; });
  expect_refused("body of particle 7 is no row of a body, nor -1: 1", [](Snapshot& s) { s.body[7] = 1; });
  expect_refused("material of particle 7 is no material of the job: -1",
                 [](Snapshot& s) { s.material[7] = -1; });
}

TEST(AuditOfValues, ATemperatureIsAboveAbsoluteZeroUnlessAWalkersErrorIsLarger) {
  Trial t(warm_bar(), "cosine_mode");
  auto& last = t.run.frames.back();
  last.temperature[2] = -1.0;
  EXPECT_NE(t.sound().find("temperature of particle 2 is not above 0 K: -1"), std::string::npos) << t.sound();
  last.temperature_error.assign(last.temperature.size(), 1.0);
  EXPECT_EQ(t.sound(), "");
  last.temperature_error[0] = -1.0;
  EXPECT_NE(t.sound().find("temperature_error of particle 0"), std::string::npos) << t.sound();
}

TEST(Angle, ToAZeroQuaternionIsNoNumber) {
  EXPECT_TRUE(std::isnan(angle_between({0, 0, 0, 0}, {})));
  EXPECT_TRUE(std::isnan(angle_between({}, {0, 0, 0, 0})));
  EXPECT_EQ(angle_between({}, {}), 0.0);
  EXPECT_EQ(angle_between({-1, 0, 0, 0}, {}), 0.0);
}

/// The sums that an engine states of a flight, from its particles.
void state_sums(Snapshot& s) {
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vec3 p = s.mass[i] * s.velocity[i];
    s.total_mass += s.mass[i];
    s.momentum += p;
    s.angular_momentum += cross(s.position[i], p);
    s.energy["kinetic"] += 0.5 * dot(s.velocity[i], p);
  }
}

/// A rigid body may turn with other moments than its particles have.
TEST(AuditOfSums, TheSumsThatARunStatesAreThoseOfItsParticles) {
  using Change = std::function<void(Snapshot&)>;
  struct Row {
    std::string words;
    bool is_rigid;
    Change change;
  };
  const Row rows[] = {
      Row{"", false, [](Snapshot&) {}},
      Row{"`mass`", true, [](Snapshot& s) { s.total_mass = -s.total_mass; }},
      Row{"`momentum.x`", true, [](Snapshot& s) { s.momentum.x *= 1.001; }},
      Row{"`angular_momentum.y`", false, [](Snapshot& s) { s.angular_momentum.y = s.momentum.z; }},
      Row{"`energy_kinetic`", false, [](Snapshot& s) { s.energy["kinetic"] *= 1.001; }},
      Row{"", true, [](Snapshot& s) { s.energy["kinetic"] *= 1.001; }},
  };
  for (const auto& [words, is_rigid, change] : rows) {
    Trial t(thrown_block(), "ballistic");
    for (auto& frame : t.run.frames) {
      state_sums(frame);
      if (!is_rigid) std::ranges::fill(frame.phase, 1);
    }
    change(t.run.frames.at(5));
    const auto why = t.sound();
    EXPECT_EQ(why.empty(), words.empty()) << why;
    EXPECT_NE(why.find(words), std::string::npos) << why;
  }
}

TEST(AuditOfSums, AMomentumIsComparedWhereItIsTheOnlySum) {
  Trial t(thrown_block(), "ballistic");
  for (auto& frame : t.run.frames) {
    state_sums(frame);
    frame.total_mass = 0.0;
    frame.energy.clear();
    frame.angular_momentum = {};
  }
  EXPECT_EQ(t.sound(), "");
  t.run.frames.at(5).momentum.x *= 1.001;
  EXPECT_NE(t.sound().find("`momentum.x`"), std::string::npos) << t.sound();
}

TEST(AuditOfSums, ARunWithoutSumsIsLetAlone) { EXPECT_EQ(Trial(thrown_block(), "ballistic").sound(), ""); }

}  // namespace
}  // namespace tripoint
