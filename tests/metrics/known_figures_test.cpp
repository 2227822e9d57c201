// SPDX-License-Identifier: BSD-3-Clause
// Each quantity on a small run whose figure can be worked out by hand. Particles of the two blocks and of the
// pool weigh 1 kg each.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "metrics/known.hpp"
#include "references/solids.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/metrics/statistics.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::pi;
using test::Still;

using test::along;
using test::Known;
using test::Numbers;
using test::still_blocks;
using test::value;

// --- of one frame

using Change = std::function<void(Snapshot& first, Snapshot& last)>;

struct Figure {
  std::string quantity, body;
  double figure = 0.0;
  Numbers numbers;
  Change change;
  std::optional<std::size_t> axis = {};  ///< that the truth is measured along
};

const std::vector<Figure>& figures() {
  static const std::vector<Figure> list{
      {"velocity",
       "left",
       5.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.bodies[0].velocity = {3, 0, -4};
       }},
      {"angular_velocity",
       "left",
       7.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.bodies[0].angular_velocity = {2, -3, 6};
       }},
      {"force",
       "right",
       3.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.bodies[1].force = {1, 2, -2};
       }},
      {"torque",
       "right",
       9.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.bodies[1].torque = {4, -4, 7};
       }},
      {"mass", "", 2.5, {}, [](Snapshot&, Snapshot& s) { s.mass[0] += 2.5; }},
      {"mass", "", -1.0, {}, [](Snapshot&, Snapshot& s) { s.id[7] = -1; }},
      {"momentum",
       "",
       5.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[3] = {0, 3, 4};
       }},
      {"momentum",
       "",
       10.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[3] = {0, 3, 4};
         s.mass[3] = 2.0;
       }},
      // two particles 0.1 m apart along z with opposite velocities of 2 m/s along x: 1 kg x 0.1 m x 2 m/s
      {"angular_momentum",
       "",
       0.2,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[0] = {2, 0, 0};
         s.velocity[1] = {-2, 0, 0};
       }},
      // 1/2 x 1 kg x 25 m2/s2 + 1 kg x 10 m/s2 x 0.3 m
      {"energy",
       "",
       15.5,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[3] = {0, 3, 4};
         s.position[5].z += 0.3;
       }},
      {"ledger.kinetic",
       "",
       12.5,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[3] = {0, 3, 4};
         s.position[5].z += 0.3;
       }},
      {"ledger.potential",
       "",
       3.0,
       {},
       [](Snapshot&, Snapshot& s) {
         s.velocity[3] = {0, 3, 4};
         s.position[5].z += 0.3;
       }},
      {"ledger.elastic",
       "",
       3.0,
       {{"value", 2.0}},
       [](Snapshot&, Snapshot& s) {
         s.energy = {{"elastic", 5.0}, {"walls", 1.0}};
       }},
      {"ledger.residual",
       "",
       5.0,
       {},
       [](Snapshot& first, Snapshot& s) {
         first.energy = {{"elastic", 2.0}, {"walls", -1.0}};
         s.energy = {{"elastic", 5.0}, {"walls", 1.0}};
       }},
      {"energy_ratio",
       "",
       -0.25,
       {{"energy_ratio", 0.5}},
       [](Snapshot& first, Snapshot& s) {
         first.velocity[3] = {0, 2, 0};
         s.velocity[4] = {0, 0, 1};
       }},
      {"bonded_objects",
       "",
       -2.0,
       {{"value", 5.0}},
       [](Snapshot&, Snapshot& s) { s.counts["objects"] = 3.0; }},
      {"processes", "", -1.0, {{"value", 3.0}}, [](Snapshot&, Snapshot& s) { s.counts["processes"] = 2.0; }},
      {"recoveries", "", 4.0, {}, [](Snapshot&, Snapshot& s) { s.counts["recoveries"] = 4.0; }},
      {"recoveries", "", 3.0, {{"value", 1.0}}, [](Snapshot&, Snapshot& s) { s.counts["recoveries"] = 4.0; }},
      {"axial_torque",
       "right",
       2.5,
       {{"torque", 4.5}},
       [](Snapshot&, Snapshot& s) {
         s.bodies[1].torque = {1, 2, 7};
       },
       2},
      // four layers from -0.35 to -0.05 m and half a spacing at both ends: 0.2 m
      {"half_length", "left", -0.1, {{"half_length", 0.3}}, [](Snapshot&, Snapshot&) {}, 0},
      {"half_length",
       "left",
       0.25,
       {{"half_length", 0.2}},
       [](Snapshot&, Snapshot& s) { s.position[2].x = -0.85; },
       0},
      {"spin_ratio",
       "left",
       -1.5,
       {{"value", 1.0}},
       [](Snapshot& first, Snapshot& s) {
         first.velocity[0] = {2, 0, 0};
         first.velocity[1] = {-2, 0, 0};
         s.velocity[0] = {-1, 0, 0};
         s.velocity[1] = {1, 0, 0};
       }},
  };
  return list;
}

/// At the end only: a ledger, say, is given to those frames that the row names.
TEST(KnownFigures, OfOneFrame) {
  for (const auto& row : figures()) {
    auto f = still_blocks();
    row.change(f.run.frames.front(), f.run.frames.back());
    auto choice = metric(row.quantity, "final", row.body);
    choice.window = {0.9, 1.0};
    Measuring measuring;
    measuring.axis = row.axis;
    const auto v = value(f, choice, row.numbers, measuring);
    EXPECT_NEAR(v.value, row.figure, 1e-12) << row.quantity << ": " << v.note;
  }
}

TEST(KnownFigures, AreNoNumberWhereTheRunHasNoVelocities) {
  for (const char* quantity : {"energy", "ledger.kinetic", "ledger.potential"}) {
    auto f = still_blocks();
    f.run.frames.back().velocity.clear();
    EXPECT_TRUE(std::isnan(value(f, metric(quantity, "final")).value)) << quantity;
  }
}

TEST(KnownFigures, OfDensitiesAndPressuresAreByVolume) {
  auto f = still_blocks();
  Snapshot truth = f.run.frames.front();
  truth.density.assign(truth.position.size(), 1000.0);
  truth.pressure.assign(truth.position.size(), 50.0);
  auto& last = f.run.frames.back();
  last.density = truth.density;
  last.pressure = truth.pressure;
  last.density[0] -= 8.0;
  last.pressure[1] += 16.0;
  const auto of = [&](const char* quantity, const char* norm) {
    return evaluate(metric(quantity, norm, "left"), f.s.job, f.s.initial, f.run, Known(truth, {})).value;
  };
  EXPECT_NEAR(of("density", "Linf"), 8.0, 1e-12);
  EXPECT_NEAR(of("density", "L2"), 1.0, 1e-12);  // one of 64 particles: 8/sqrt(64)
  EXPECT_NEAR(of("pressure", "L1"), 0.25, 1e-12);
  EXPECT_NEAR(of("pressure", "L2"), 2.0, 1e-12);
}

/// T = 300 + 100 x along the two blocks, which reach from -0.4 to 0.4 m: 300 K is halfway between the
/// extremes.
TEST(KnownFigures, OfAProfileAndItsIsotherm) {
  auto s = test::blocks();
  for (const Vec3& r : s.initial.position) s.initial.temperature.push_back(300.0 + 100.0 * r.x);
  Still f(s);
  for (auto& frame : f.run.frames) frame.temperature = s.initial.temperature;
  Snapshot truth = f.run.frames.front();
  auto& last = f.run.frames.back();
  const auto of = [&](const char* quantity, const char* norm, const char* body) {
    return evaluate(metric(quantity, norm, body), f.s.job, f.s.initial, f.run, Known(truth, {}, along(0)))
        .value;
  };
  for (double& T : last.temperature) T += 2.0;
  EXPECT_NEAR(of("front", "final", ""), -0.02, 1e-12);
  EXPECT_NEAR(of("temperature_profile", "Linf", "left"), 2.0, 1e-9);
  last.temperature = truth.temperature;
  // a layer of 16: its mean is 1 K off
  for (std::size_t i = 0; i < 16; ++i) last.temperature[i] += i % 2 == 0 ? 3.0 : -1.0;
  EXPECT_NEAR(of("temperature_profile", "Linf", "left"), 1.0, 1e-9);
  EXPECT_NEAR(of("temperature_profile", "L1", "left"), 0.25, 1e-9);  // one of four layers
}

// --- of a series

/// A single number in time: so many objects at t = 0, 0.25, 0.5, 0.75 and 1 s.
Still counted(const std::vector<double>& objects) {
  auto f = still_blocks(static_cast<int>(objects.size()) - 1);
  for (std::size_t n = 0; n < objects.size(); ++n) f.run.frames[n].counts["objects"] = objects[n];
  return f;
}

double of_series(const Still& f, const std::string& norm, const std::string& at = "",
                 const std::array<double, 2>& window = {0.0, 0.0}) {
  auto choice = metric("bonded_objects", norm);
  choice.at = at;
  choice.window = window;
  return value(f, choice, {{"value", 0.0}}).value;
}

TEST(KnownFigures, OfEachNormInTime) {
  const auto f = counted({3, 2, -4, 2, 1});
  EXPECT_NEAR(of_series(f, "final"), 1.0, 1e-12);
  EXPECT_NEAR(of_series(f, "max"), 4.0, 1e-12);
  // Trapezia of (3 + 2)/2, (2 - 4)/2, (-4 + 2)/2 and (2 + 1)/2, over 4
  EXPECT_NEAR(of_series(f, "mean"), 0.5, 1e-12);
  // Trapezia of the squares: (13 + 20 + 20 + 5)/2/4
  EXPECT_NEAR(of_series(f, "rms"), std::sqrt(7.25), 1e-12);
  EXPECT_NEAR(of_series(f, "mean", "", {0.25, 0.75}), -1.0, 1e-12);
  EXPECT_NEAR(of_series(f, "max", "", {0.75, 1.0}), 2.0, 1e-12);
  EXPECT_NEAR(of_series(counted({1, 2, 3, 4, 5}), "slope"), 4.0, 1e-12);
  EXPECT_NEAR(of_series(counted({3, 7, 3, 7, 3, 7, 3, 7, 3, 7, 3, 7, 3, 7, 3, 7}), "stationary"), 5.0, 1e-12);
}

TEST(KnownFigures, OfANormInSpaceAreOfTheTimeThatIsAskedFor) {
  const auto f = counted({1, 2, -4, 3, 1});
  for (const char* at : {"0.75", "0.75 s", "0.75s"}) EXPECT_NEAR(of_series(f, "Linf", at), 3.0, 1e-12) << at;
  EXPECT_NEAR(of_series(f, "Linf", "0.25"), 2.0, 1e-12);
  EXPECT_NEAR(of_series(f, "Linf", "end"), 1.0, 1e-12);
  EXPECT_NEAR(of_series(f, "Linf", "all"), 4.0, 1e-12);
  for (const char* at : {"0.7", "0.75 ms", "noon"})
    EXPECT_THROW((void)of_series(f, "Linf", at), InputError) << at;
}

// --- of a whole run

TEST(KnownFigures, OfASwayAreOneForAnyAxisAndAnyStart) {
  auto f = still_blocks(100);
  for (auto& frame : f.run.frames)
    f.shift(frame, 1, {0.3, 0.02 + 0.01 * std::sin(2.0 * pi * 3.6 * frame.time), 0.0});
  const auto of = [&](double stated) {
    return value(f, metric("sway_frequency", "final", "right"), {{"value", stated}}, along(1)).value;
  };
  EXPECT_NEAR(of(3.6), 0.0, 1e-7);  // golden section: square root of round-off
  EXPECT_NEAR(of(3.0), 0.2, 1e-7);
  EXPECT_NEAR(of(4.5), -0.2, 1e-7);
}

TEST(KnownFigures, OfASpinAreItsRateOfDecayWhateverTheDrift) {
  auto f = still_blocks();
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.position.size(); ++i)
      frame.velocity[i] =
          Vec3{5, -2, 1} + std::exp(-0.7 * frame.time) * cross({0, 0, 3.0}, frame.position[i]);
  EXPECT_NEAR(value(f, metric("spin_rate", "final", "left"), {{"spin_rate", 0.5}}).value, 0.2, 1e-9);
}

TEST(KnownFigures, OfASwingAreItsAmplitudeFrequencyAndSag) {
  Still f(test::beam(2.0));
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < f.s.initial.size(); ++i)
      if (f.s.initial.source[i] == 0)
        frame.position[i].z -= 0.003 + 0.005 * std::sin(2.0 * pi * 6.0 * frame.time);
  const Numbers numbers{{"frequency", 2.0 * pi * 5.0}, {"amplitude", 0.004}, {"deflection", 0.002}};
  Measuring bar = along(0);
  bar.bar = 0;
  bar.direction = Vec3{0.0, 0.0, -1.0};
  bar.free_end_is_high = true;
  EXPECT_NEAR(value(f, metric("swing_amplitude", "final"), numbers, bar).value, 0.25, 1e-6);
  EXPECT_NEAR(value(f, metric("frequency", "final"), numbers, bar).value, 0.2, 1e-6);
  EXPECT_NEAR(value(f, metric("sag", "final"), numbers, bar).value, 0.5, 1e-6);
}

TEST(KnownFigures, OfAForceAreItsMeanItsSwingAndItsFrequencyOverAWindow) {
  auto f = still_blocks(200);
  for (auto& frame : f.run.frames) {
    const double grows = frame.time < 0.2 ? 10.0 : 0.0, sine = std::sin(2.0 * pi * 5.0 * frame.time);
    frame.bodies[1].force = {3.0 + 2.0 * sine + grows, 0.0, 0.0};
    frame.bodies[1].torque = {0.0, -frame.bodies[1].force.x, 0.0};
  }
  const auto of = [&](const char* quantity, const char* norm, const char* axis, const char* key,
                      double stated) {
    auto choice = metric(quantity, norm, "right");
    choice.window = {0.2, 1.0};
    return f.stated(choice, {{"axis", std::string(axis)}, {key, stated}});
  };
  EXPECT_NEAR(of("force", "mean", "x", "value", 2.5), 0.5, 1e-12);
  EXPECT_NEAR(of("force", "swing", "x", "amplitude", 1.5), 0.5, 1e-12);
  EXPECT_NEAR(of("force", "frequency", "x", "frequency", 4.0), 1.0, 1e-6);
  EXPECT_NEAR(of("torque", "mean", "y", "value", -2.5), -0.5, 1e-12);
  EXPECT_NEAR(of("torque", "swing", "y", "amplitude", 1.5), 0.5, 1e-12);
  EXPECT_NEAR(of("torque", "frequency", "y", "frequency", 4.0), 1.0, 1e-6);
  EXPECT_TRUE(std::isnan(of("force", "swing", "x", "value", 1.5)));  // no amplitude is stated
  EXPECT_NEAR(f.of(metric("force", "swing", "right"), "self", {{"axis", std::string("x")}}).value,
              0.5 * (15.0 - 1.0), 1e-2);
}

TEST(KnownFigures, OfAnAverageAreThoseOfTheTimesAroundEachOutput) {
  auto f = still_blocks(100);
  double sign = 1.0;
  for (auto& frame : f.run.frames) f.shift(frame, 1, {0.03 * (sign = -sign), 0.0, 0.0});
  const auto of = [&](const char* norm, double average, const char* at = "end") {
    auto choice = metric("centre", norm, "right");
    choice.average = average;
    choice.at = at;
    return f.of(choice, "stated", {{"axis", std::string("x")}, {"value", 0.2}});
  };
  EXPECT_NEAR(of("max", 0.0).value, 0.03, 1e-12);
  EXPECT_NEAR(of("max", 0.02).value, 0.01, 1e-12);          // one of three is left
  EXPECT_NEAR(of("final", 0.02).value, 0.0, 1e-12);         // of two, at the end
  EXPECT_NEAR(of("Linf", 0.02, "0.5").value, 0.01, 1e-12);  // at a time
  EXPECT_NE(of("max", 0.01).note.find("shorten scene.output_interval"), std::string::npos);
  EXPECT_NE(of("chi", 0.02).note.find("every norm but"), std::string::npos);
  auto many = metric("velocity", "max");
  many.average = 0.02;
  EXPECT_NE(value(f, many).note.find("of a single number"), std::string::npos);
  auto whole = metric("touch_time", "final", "right");
  whole.average = 0.02;
  EXPECT_NE(value(f, whole, {{"touch_time", 0.5}}, along(1)).note.find("of the whole run"),
            std::string::npos);
}

TEST(KnownFigures, OfTogglesCountAChangeInTheFirstIntervalToo) {
  auto f = still_blocks();
  f.run.frames[1].phase[3] = 0;  // melts in the first interval and freezes in the second
  EXPECT_EQ(value(f, metric("toggles", "final"), {{"value", 0.0}}).value, 1.0);
  auto g = still_blocks();
  g.run.frames[4].phase[3] = 0;
  EXPECT_EQ(value(g, metric("toggles", "final"), {{"value", 0.0}}).value, 0.0);
}

// --- means of blocks

/// 1, 1, -1, -1 again and again: the mean of n samples is known to sqrt(1/(n - 1)), that of n/2 pairs to
/// sqrt(1/(n/2 - 1)).
TEST(KnownFigures, OfAStationaryMeanAreTheBlocksOfPairs) {
  std::vector<double> x;
  for (int n = 0; n < 16; ++n) x.push_back(n % 4 < 2 ? 1.0 : -1.0);
  const auto even = stationary_mean(x);
  EXPECT_EQ(even.burn_in, 0u);
  EXPECT_NEAR(even.value, 0.0, 1e-15);
  EXPECT_NEAR(even.uncertainty, std::sqrt(1.0 / 7.0), 1e-12);
  EXPECT_NEAR(even.effective, 16.0 * 7.0 / 15.0, 1e-9);
  EXPECT_FALSE(even.plateau);
  // An odd sample belongs to no pair: beyond it is memory of somebody else, which the build with the address
  // sanitizer sees
  x.push_back(0.0);
  const auto odd = stationary_mean(x);
  EXPECT_EQ(odd.burn_in, 0u);
  EXPECT_NEAR(odd.value, 0.0, 1e-15);
  EXPECT_NEAR(odd.uncertainty, std::sqrt(1.0 / 7.0), 1e-12);
  EXPECT_NEAR(odd.effective, 17.0 * 7.0 / 17.0, 1e-9);
}

}  // namespace
}  // namespace tripoint
