// SPDX-License-Identifier: BSD-3-Clause
// What a run or its truth leaves out: which of it is an error, which is a gap that no metric looks at, and
// the words that say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/known.hpp"
#include "validation/audit/audit.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

using test::along;
using test::Known;
using test::metric;
using test::Still;
using test::still_blocks;
using test::value;

struct Gap {
  std::string quantity, body, says;  ///< empty: the value is 0
  std::function<void(Snapshot& run, Snapshot& truth)> change;
};

TEST(KnownGaps, OfParticlesAndBodiesAreToldApart) {
  const auto warm = [](Snapshot& s) { s.temperature.assign(136, 300.0); };
  const std::vector<Gap> gaps{
      {"position", "", "", [](Snapshot&, Snapshot&) {}},
      {"position", "", "position of particle 3 is not finite or missing",
       [](Snapshot& r, Snapshot&) { r.position[3].x = not_a_number; }},
      {"position", "", "position of particle 3 is there, but not in the reference",
       [](Snapshot&, Snapshot& t) { t.position[3].x = not_a_number; }},
      {"position", "", "position of particle 3 is not finite or missing",
       [](Snapshot& r, Snapshot& t) { r.position[3].x = t.position[3].x = not_a_number; }},
      {"position", "", "",
       [](Snapshot& r, Snapshot& t) {
         r.position[3].x = t.position[3].x = not_a_number;
         r.id[3] = -1;
       }},
      {"position", "", "position of particle 3 is there, but not in the reference",
       [](Snapshot& r, Snapshot& t) {
         t.position[3].x = not_a_number;
         r.id[3] = -1;
       }},
      {"velocity", "", "the trajectory has no velocity", [](Snapshot& r, Snapshot&) { r.velocity.clear(); }},
      {"velocity", "", "the reference does not know the velocity",
       [](Snapshot&, Snapshot& t) { t.velocity.clear(); }},
      {"velocity", "", "velocity: 136 particles against 135",
       [](Snapshot&, Snapshot& t) { t.velocity.pop_back(); }},
      {"temperature", "", "temperature of particle 5 is not finite or missing",
       [=](Snapshot& r, Snapshot& t) {
         warm(r);
         warm(t);
         r.temperature[5] = not_a_number;
       }},
      {"temperature", "", "temperature of particle 5 is there, but not in the reference",
       [=](Snapshot& r, Snapshot& t) {
         warm(r);
         warm(t);
         t.temperature[5] = not_a_number;
       }},
      {"temperature", "", "",
       [=](Snapshot& r, Snapshot& t) {
         warm(r);
         warm(t);
         r.temperature[5] = t.temperature[5] = not_a_number;
         r.id[5] = -1;
       }},
      {"temperature", "", "a standard error of the temperature is not finite",
       [=](Snapshot& r, Snapshot& t) {
         warm(r);
         warm(t);
         r.temperature_error.assign(136, 0.1);
         r.temperature_error[9] = not_a_number;
       }},
      {"temperature_error", "", "the trajectory has no temperature_error",
       [](Snapshot& r, Snapshot&) { r.temperature_error.assign(135, 0.0); }},
      {"temperature_error", "", "temperature_error of particle 7 is not finite or missing",
       [](Snapshot& r, Snapshot&) {
         r.temperature_error.assign(136, 0.0);
         r.temperature_error[7] = not_a_number;
       }},
      {"orientation", "", "", [](Snapshot&, Snapshot&) {}},
      {"orientation", "", "the reference does not know the bodies",
       [](Snapshot&, Snapshot& t) { t.bodies.clear(); }},
      {"orientation", "pool", "body `pool` is liquid and has no row", [](Snapshot&, Snapshot&) {}},
      {"orientation", "", "body row 1 is missing or not finite at t = 1.000000 s",
       [](Snapshot& r, Snapshot&) { r.bodies.pop_back(); }},
      {"orientation", "", "body row 1 is missing or not finite at t = 1.000000 s",
       [](Snapshot& r, Snapshot&) { r.bodies[1].position.x = not_a_number; }},
      {"orientation", "", "body row 1 should not exist at t = 1.000000 s",
       [](Snapshot&, Snapshot& t) { t.bodies[1].position.x = not_a_number; }},
      {"orientation", "", "body row 1 should not exist at t = 1.000000 s",
       [](Snapshot&, Snapshot& t) { t.bodies.pop_back(); }},
      {"orientation", "", "",
       [](Snapshot& r, Snapshot& t) { r.bodies[1].position.x = t.bodies[1].position.x = not_a_number; }},
      {"orientation", "right", "body row 1 is missing or not finite at t = 1.000000 s",
       [](Snapshot& r, Snapshot& t) { r.bodies[1].position.x = t.bodies[1].position.x = not_a_number; }},
      {"orientation", "left", "", [](Snapshot& r, Snapshot&) { r.bodies[1].position.x = not_a_number; }},
      {"orientation", "", "body row 0 is not finite",
       [](Snapshot& r, Snapshot&) { r.bodies[0].velocity.x = not_a_number; }},
      {"orientation", "", "body row 0 is not finite",
       [](Snapshot& r, Snapshot&) { r.bodies[0].angular_velocity.x = not_a_number; }},
      {"orientation", "", "body row 0 is not finite",
       [](Snapshot& r, Snapshot&) { r.bodies[0].orientation.y = not_a_number; }},
      {"shape", "left", "", [](Snapshot&, Snapshot&) {}},
      {"shape", "", "there is no rigid body of two particles or more", [](Snapshot&, Snapshot&) {}},
      {"shape", "pool", "there is no rigid body of two particles or more", [](Snapshot&, Snapshot&) {}},
      {"shape", "left", "the trajectory has no positions and bodies of all particles",
       [](Snapshot& r, Snapshot&) { r.body.clear(); }},
      {"mass", "", "the reference does not know the mass: use norm = \"drift\"",
       [](Snapshot&, Snapshot& t) { t.position.clear(); }},
      {"mass", "", "",
       [](Snapshot&, Snapshot& t) {
         t.position.clear();
         t.total_mass = 136.0;
       }},
      {"momentum", "", "",
       [](Snapshot&, Snapshot& t) {
         t.position.clear();
         t.total_mass = 136.0;
       }},
      {"momentum", "", "the trajectory has no positions and velocities",
       [](Snapshot& r, Snapshot&) { r.velocity.clear(); }},
      {"momentum", "", "the reference has no particles to sum the momentum of: use norm = \"drift\"",
       [](Snapshot&, Snapshot& t) { t.position.clear(); }},
      {"angular_momentum", "",
       "the reference has no particles to sum the angular momentum of: use norm = \"drift\"",
       [](Snapshot&, Snapshot& t) { t.velocity.clear(); }},
      {"energy", "", "the reference has no particles to sum the energy of: use norm = \"drift\"",
       [](Snapshot&, Snapshot& t) { t.velocity.clear(); }},
      {"ledger.elastic", "", "the trajectory has no ledger term `elastic`", [](Snapshot&, Snapshot&) {}},
      {"ledger.elastic", "", "the reference does not know the ledger term `elastic`: use norm = \"drift\"",
       [](Snapshot& r, Snapshot&) { r.energy["elastic"] = 1.0; }},
      {"ledger.elastic", "", "",
       [](Snapshot& r, Snapshot& t) { r.energy["elastic"] = t.energy["elastic"] = 1.0; }},
      {"ledger.thermal", "", "the trajectory has no ledger term `thermal`",
       [=](Snapshot& r, Snapshot& t) {
         warm(r);
         warm(t);
       }},
      {"energy_ratio", "", "the reference does not know the energy ratio and states no value",
       [](Snapshot&, Snapshot&) {}},
      {"object_count", "", "the trajectory has no positions, phases and bodies of all particles",
       [](Snapshot& r, Snapshot&) { r.phase.clear(); }},
      {"object_count", "", "the reference does not know the object_count and states no value",
       [](Snapshot&, Snapshot&) {}},
      {"half_length", "", "the reference knows no half length", [](Snapshot&, Snapshot&) {}},
      {"pressure_factor", "", "the trajectory has no pressure", [](Snapshot&, Snapshot&) {}},
      {"pressure_factor", "", "the reference does not know the pressure",
       [](Snapshot& r, Snapshot&) { r.pressure.assign(136, 1.0); }},
      {"pressure_factor", "", "the true pressure is zero everywhere",
       [](Snapshot& r, Snapshot& t) {
         r.pressure.assign(136, 1.0);
         t.pressure.assign(136, 0.0);
       }},
      {"pressure_factor", "", "", [](Snapshot& r, Snapshot& t) {
         r.pressure.assign(136, 2.0);
         t.pressure.assign(136, 2.0);
         t.pressure[0] = not_a_number;
       }}};
  for (const auto& row : gaps) {
    auto f = still_blocks();
    Snapshot truth = f.run.frames.back();
    row.change(f.run.frames.back(), truth);
    auto choice = metric(row.quantity, "final", row.body);
    choice.window = {0.9, 1.0};
    const auto v = evaluate(choice, f.s.job, f.s.initial, f.run, Known(truth, {}));
    if (row.says.empty())
      EXPECT_NEAR(v.value, 0.0, 1e-12) << row.quantity << ": " << v.note;
    else
      EXPECT_EQ(v.note, row.says) << row.quantity;
    EXPECT_EQ(std::isnan(v.value), !row.says.empty()) << row.quantity << ": " << row.says;
  }
}

/// 48 particles of one count of walkers that is 1 K off, and 16 of another that is 3 K off.
TEST(KnownGaps, ACountOfWalkersWeighsAsMuchAsItsParticles) {
  auto f = still_blocks();
  Snapshot truth = f.run.frames.back();
  truth.temperature.assign(136, 300.0);
  auto& last = f.run.frames.back();
  last.temperature_error.assign(136, 0.1);
  for (std::size_t i = 0; i < 136; ++i) last.temperature.push_back(i < 48 ? 301.0 : 303.0);
  const auto v = evaluate(metric("temperature", "L1", "left"), f.s.job, f.s.initial, f.run, Known(truth, {}));
  EXPECT_NEAR(v.value, 1.5, 1e-12);
  // two samples of shares 3/4 and 1/4, and the mean size of the noise
  EXPECT_NEAR(v.uncertainty.statistical, 0.1 * std::sqrt(10.0 / 16.0 + 2.0 / test::pi), 1e-12);
}

TEST(KnownGaps, ADifferenceInPhasesIsTheLargestOfTheThree) {
  auto f = still_blocks();
  auto& phase = f.run.frames.back().phase;
  for (std::size_t i = 0; i < 5; ++i) phase[i] = 0;
  for (std::size_t i = 5; i < 7; ++i) phase[i] = 2;
  EXPECT_EQ(value(f, metric("phase_count", "final")).value, -7.0);
  EXPECT_EQ(value(f, metric("phase_count", "final", "right")).value, 0.0);
  for (std::size_t i = 128; i < 136; ++i) phase[i] = 2;
  EXPECT_EQ(value(f, metric("phase_count", "final")).value, 10.0);
}

/// 16 particles of which a quarter is liquid yet, the others of the bar are liquid: 16 x 0.75 of 1 l over
/// 0.16 m2.
TEST(KnownGaps, AFrontThatFreezesIsTheVolumeThatIsNoLongerLiquid) {
  auto f = still_blocks();
  auto& last = f.run.frames.back();
  last.liquid_fraction.assign(136, 1.0);
  for (std::size_t i = 0; i < 16; ++i) last.liquid_fraction[i] = 0.25;
  Measuring m;
  m.bar = 0;
  m.melts = false;
  const auto of = [&](const char* quantity, double truth) {
    auto choice = metric(quantity, "final");
    choice.window = {0.9, 1.0};
    return value(f, choice, {{"area", 0.16}, {"front_position", truth}}, m);
  };
  EXPECT_NEAR(of("front_position", 0.1).value, -0.025, 1e-12);
  EXPECT_NEAR(of("front_ratio", 0.1).value, -0.25, 1e-12);
  EXPECT_EQ(of("front_ratio", 0.0).note,
            "the front has not started: choose a window or `at` after the start");
  m.melts = true;
  EXPECT_NEAR(of("front_position", 0.1).value, (48.0 + 4.0) * 0.001 / 0.16 - 0.1, 1e-12);
  last.liquid_fraction.clear();
  for (std::size_t i = 0; i < 8; ++i) last.phase[i] = 0;
  EXPECT_NEAR(of("front_position", 0.1).value, 8.0 * 0.001 / 0.16 - 0.1, 1e-12);
  last.phase.clear();
  EXPECT_EQ(of("front_position", 0.1).note, "the trajectory has no phases");
  m.melts.reset();
  EXPECT_EQ(of("front_position", 0.1).note, "the reference knows no front");
}

/// The left block moves on at a speed, and its places do not change: that is a fault where its way is more
/// than half a unit in the last of the 24 bits of a coordinate.
TEST(KnownGaps, ARunIsFrozenWhereItsWayWouldShow) {
  auto s = test::blocks();
  s.job.reference.kind = ReferenceKind::invariant;
  double farthest = 0.0;
  for (const Vec3& r : s.initial.position) farthest = std::max(farthest, norm(r));
  for (const auto& [share, frozen] : {std::pair{1.001, true}, std::pair{0.999, false}}) {
    Still f(s);
    const Vec3 v{share * 6e-8 * farthest / 0.25, 0, 0};
    f.s.job.bodies[0].velocity = v;
    std::fill_n(f.s.initial.velocity.begin(), 64, v);
    for (auto& frame : f.run.frames)
      for (std::size_t i = 0; i < 64; ++i) {
        frame.velocity[i] = v;
        frame.bodies[0].velocity = v;
      }
    // the last frame is another, so that the run as a whole has moved
    for (auto& r : f.run.frames.back().position) r.x += 1e-3;
    for (auto& b : f.run.frames.back().bodies) b.position.x += 1e-3;
    const auto says = audit(f.s.job, f.s.initial, f.run);
    const std::string words =
        "frozen: no particle moves from t = 0.000000 to 0.250000 s, yet they have velocities";
    EXPECT_EQ(says == words, frozen) << share << says;
  }
}

}  // namespace
}  // namespace tripoint
