// SPDX-License-Identifier: BSD-3-Clause
// Quantities of whole runs, of boxes and of times: with figures worked out by hand and at the edges.
#include <gtest/gtest.h>

#include <cmath>

#include "metrics/known.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

using test::along;
using test::Known;
using test::metric;
using test::Numbers;
using test::pi;
using test::Still;
using test::still_blocks;
using test::value;

// --- boxes

/// A box that is no more than one particle's place holds it, and none of its six faces may be moved beyond
/// that place.
TEST(KnownBoxes, HoldWhatLiesOnTheirFaces) {
  for (const char* quantity : {"mass_in_region", "mean_density"}) {
    auto f = still_blocks();
    for (auto& frame : f.run.frames) frame.density.assign(f.s.initial.size(), 2.0);
    const Vec3 place = f.s.initial.position[21];
    const auto in_box = [&](const Vec3& low, const Vec3& high) {
      Measuring m;
      m.box = MeasuredBox{low, high};
      return value(f, metric(quantity, "final"), {{"value", 0.0}}, m).value;
    };
    const double held = quantity == std::string("mean_density") ? 2.0 : 1.0;
    EXPECT_NEAR(in_box(place, place), held, 1e-14) << quantity;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 low = place, high = place;
      high[k] -= 1e-9;
      const double none = in_box(low, high);
      EXPECT_TRUE(held == 1.0 ? none == 0.0 : std::isnan(none)) << quantity << " high " << k;
      low = high = place;
      low[k] += 1e-9;
      high[k] += 2e-9;
      const double beyond = in_box(low, high);
      EXPECT_TRUE(held == 1.0 ? beyond == 0.0 : std::isnan(beyond)) << quantity << " low " << k;
    }
  }
}

TEST(KnownBoxes, NeedTheBodyThatTheyFollow) {
  auto f = still_blocks();
  Measuring m;
  m.box = MeasuredBox{{-1, -1, -1}, {1, 1, 1}};
  m.follows = true;
  const auto of = [&](const char* body) {
    return value(f, metric("mass_in_region", "final", body), {{"value", 0.0}}, m).value;
  };
  EXPECT_NEAR(of("left"), 128.0, 1e-12);
  EXPECT_TRUE(std::isnan(of("")));
  EXPECT_TRUE(std::isnan(of("pool")));
  f.run.frames.back().bodies[0].position.x = not_a_number;
  EXPECT_TRUE(std::isnan(of("left")));
  f.run.frames.back().bodies.resize(1);
  EXPECT_TRUE(std::isnan(of("right")));
}

// --- times

TEST(KnownTimes, AreMetWithinABillionthOfTheLast) {
  const auto position = metric("mass", "final");
  for (const double sign : {1.0, -1.0})
    for (std::size_t n = 0; n < 5; ++n) {
      auto f = still_blocks();
      f.run.frames[n].time += sign * 0.9e-9;
      EXPECT_EQ(value(f, position).value, 0.0) << n;
      f.run.frames[n].time += sign * 0.3e-9;
      EXPECT_NE(value(f, position).note.find("time not reached"), std::string::npos) << n;
    }
}

TEST(KnownTimes, AWindowHoldsBothItsEnds) {
  auto f = still_blocks();
  for (std::size_t n = 0; n < 5; ++n) f.run.frames[n].counts["objects"] = static_cast<double>(n == 0 ? 9 : n);
  const auto mean = [&](double from, double to) {
    auto choice = metric("bonded_objects", "mean");
    choice.window = {from, to};
    return value(f, choice, {{"value", 0.0}}).value;
  };
  EXPECT_NEAR(mean(0.25, 0.75), 2.0, 1e-12);
  EXPECT_NEAR(mean(0.25 + 0.9e-9, 0.75 - 0.9e-9), 2.0, 1e-12);
  EXPECT_NEAR(mean(0.25 + 1.2e-9, 0.75), 2.5, 1e-12);
  EXPECT_NEAR(mean(0.25, 0.75 - 1.2e-9), 1.5, 1e-12);
  EXPECT_NEAR(mean(0.0, 0.25), 5.0, 1e-12);
  EXPECT_TRUE(std::isnan(mean(0.0, 0.1)));
  EXPECT_TRUE(std::isnan(mean(0.3, 0.4)));
}

TEST(KnownTimes, OfARunThatIsNoneAreNamed) {
  const auto note = [](const Still& f) { return value(f, metric("mass", "final")).note; };
  auto f = still_blocks();
  std::swap(f.run.frames[2].time, f.run.frames[3].time);
  EXPECT_EQ(note(f), "times do not increase at frame 3");
  f = still_blocks();
  f.run.frames[1].time = 0.0;
  EXPECT_EQ(note(f), "times do not increase at frame 1");
  f.run.frames.clear();
  EXPECT_EQ(note(f), "the trajectory is empty");
  f = still_blocks();
  std::swap(f.run.frames[2].id[4], f.run.frames[2].id[6]);
  EXPECT_EQ(note(f), "ids are permuted: row 4 holds particle 6 at t = 0.500000 s");
  f = still_blocks();
  f.run.frames[2].position.pop_back();
  EXPECT_EQ(note(f), "the frame at t = 0.500000 s has 135 particles, the job 136");
  f.s.job.scene.inflows.resize(1);
  EXPECT_EQ(note(f), "the frame at t = 0.500000 s has 135 particles, the job 136");
  f.run.frames[2].position.resize(137);
  EXPECT_EQ(note(f).find("particles, the job"), std::string::npos);
}

// --- units

TEST(KnownUnits, OfAValueAreItsOwnOrThoseThatItsScaleGives) {
  struct Row {
    const char *quantity, *norm, *unit;
    double scale;
    bool refused;
  };
  for (const Row& row :
       {Row{"position", "max", "", 1.0, false}, Row{"position", "max", "m", 1.0, false},
        Row{"position", "max", "mm", 1.0, true}, Row{"position", "max", "mm", 1e-3, false},
        Row{"position", "final", "mm", 1.0, true}, Row{"position", "rms", "mm", 1.0, true},
        Row{"position", "mean", "mm", 1.0, true}, Row{"position", "slope", "mm", 1.0, false},
        Row{"position", "frequency", "mm", 1.0, false}, Row{"position", "chi", "mm", 1.0, false},
        Row{"temperature", "max", "degC", 1.0, false}, Row{"ledger.kinetic", "max", "J", 7.0, false},
        Row{"ledger.kinetic", "max", "kJ", 1.0, true}, Row{"ledger.kinetic", "max", "kJ", 1e3, false},
        Row{"position", "max", "spacings", 0.1, false}, Row{"position", "max", "s", 1.0, false}}) {
    auto f = still_blocks();
    auto choice = metric(row.quantity, row.norm);
    choice.unit = row.unit;
    choice.scale = row.scale;
    if (row.refused)
      EXPECT_THROW((void)value(f, choice), InputError) << row.quantity << " " << row.norm << " " << row.unit;
    else
      EXPECT_NO_THROW((void)value(f, choice)) << row.quantity << " " << row.norm << " " << row.unit;
  }
  for (const double scale : {0.0, -1.0}) {
    auto choice = metric("position", "max");
    choice.scale = scale;
    EXPECT_THROW((void)value(still_blocks(), choice), InputError);
  }
}

// --- uncertainties over time

/// Objects of 0, 1, 3, 0 and 1 at t = 0 to 1 s: mean 1, slope 0.4, squares left 6 - 0.1.
TEST(KnownSeries, HaveTheUncertaintyOfTheirTrend) {
  auto f = still_blocks();
  const double count[] = {0, 1, 3, 0, 1};
  for (std::size_t n = 0; n < 5; ++n) f.run.frames[n].counts["objects"] = count[n];
  const auto slope = value(f, metric("bonded_objects", "slope"), {{"value", 0.0}});
  EXPECT_NEAR(slope.value, 0.4, 1e-12);
  EXPECT_NEAR(slope.uncertainty.numerical, std::sqrt(5.9 / 3.0 / 0.625), 1e-12);
  auto scaled = metric("bonded_objects", "slope");
  scaled.scale = 0.5;
  EXPECT_NEAR(value(f, scaled, {{"value", 0.0}}).uncertainty.numerical, 2.0 * std::sqrt(5.9 / 3.0 / 0.625),
              1e-12);
  auto two = metric("bonded_objects", "slope");
  two.window = {0.25, 0.5};
  EXPECT_NEAR(value(f, two, {{"value", 0.0}}).value, 8.0, 1e-12);
  EXPECT_TRUE(std::isnan(value(f, two, {{"value", 0.0}}).uncertainty.numerical));
  two.window = {0.25, 0.25};
  EXPECT_EQ(value(f, two, {{"value", 0.0}}).note, "a slope needs two output times or more");
  EXPECT_NE(value(f, metric("bonded_objects", "max"), {{"value", 0.0}}).note.find("at t = 0.5"),
            std::string::npos);
}

/// A speed of the same figures: the deviations change sign twice, so that four are independent.
TEST(KnownSeries, OfASpeedHaveTheUncertaintyOfTheirSwings) {
  auto f = still_blocks();
  const double speed[] = {0, 1, 3, 0, 1};
  for (std::size_t n = 0; n < 5; ++n) f.run.frames[n].bodies[1].velocity = {7.0, speed[n], 9.0};
  const auto a = value(f, metric("acceleration", "final", "right"), {{"acceleration", 0.1}}, along(1));
  EXPECT_NEAR(a.value, 0.3, 1e-12);
  EXPECT_NEAR(a.uncertainty.numerical, std::sqrt(5.9 / (4.0 - 2.0) / 0.625), 1e-12);
  EXPECT_NEAR(
      value(f, metric("acceleration", "final", "right"), {{"acceleration", 0.1}, {"up", -1.0}}, along(1))
          .value,
      -0.5, 1e-12);
  const double touch[] = {2, 2, 2, 4, 4};
  for (std::size_t n = 0; n < 5; ++n) f.run.frames[n].bodies[1].velocity.y = touch[n];
  const auto t = value(f, metric("touch_time", "final", "right"), {{"touch_time", 0.5}}, along(1));
  EXPECT_NEAR(t.value, 0.125, 1e-12);
  EXPECT_NEAR(t.uncertainty.numerical, 0.25 / std::sqrt(12.0), 1e-12);
  EXPECT_TRUE(
      std::isnan(value(f, metric("touch_time", "final", "right"), {{"touch_time", 0.5}}, along(0)).value));
  f.run.frames[2].bodies[1].velocity.y = 3.0;  // a frame at the very middle of the change
  EXPECT_NEAR(value(f, metric("touch_time", "final", "right"), {{"touch_time", 0.5}}, along(1)).value, 0.0,
              1e-12);
}

TEST(KnownSeries, TakeTheUncertaintyOfTheirDataWhereTheyTakeTheirValue) {
  auto f = still_blocks();
  for (auto& frame : f.run.frames) frame.counts["objects"] = 1.0;
  Known truth(f.run.frames.front(), {{"value", 0.0}});
  truth.deviation = [](double t) { return t < 0.6 ? 0.5 : 0.125; };
  const auto of = [&](const char* norm, double scale) {
    auto choice = metric("bonded_objects", norm);
    choice.scale = scale;
    return evaluate(choice, f.s.job, f.s.initial, f.run, truth).uncertainty.data;
  };
  EXPECT_EQ(of("final", 1.0), 0.125);
  EXPECT_EQ(of("max", 1.0), 0.5);
  EXPECT_EQ(of("mean", 4.0), 0.125);
}

// --- events

TEST(KnownEvents, LieBetweenTwoFrames) {
  auto f = still_blocks();
  for (std::size_t n = 3; n < 5; ++n) f.run.frames[n].bodies[1].position.x = not_a_number;
  for (const auto& [truth, off] : {std::pair{0.6, 0.0}, std::pair{0.5, 0.0}, std::pair{0.75, 0.0},
                                   std::pair{0.4, 0.1}, std::pair{0.9, -0.15}}) {
    const auto v = value(f, metric("event_time", "final"), {{"value", truth}});
    EXPECT_NEAR(v.value, off, 1e-12) << truth;
    EXPECT_NEAR(v.uncertainty.numerical, 0.25 / std::sqrt(12.0), 1e-12);
  }
  EXPECT_EQ(value(still_blocks(), metric("event_time", "final"), {{"value", 0.5}}).note,
            "the number of bodies never changes: the event did not happen");
}

/// cos(k x) of -1, 1, -1, 1 in the four layers of the left block, of 4 K at the start.
TEST(KnownEvents, OfAModeThatDecaysIsItsRateWithTheErrorsOfItsWalkers) {
  auto f = still_blocks(1);
  Measuring m;
  m.wave = MeasuredWave{{pi / 0.1, 0, 0}, 0.5 * pi, {}};
  f.s.initial.temperature.assign(f.s.initial.size(), 300.0);
  for (auto& frame : f.run.frames) {
    frame.temperature.assign(f.s.initial.size(), 300.0);
    frame.temperature_error.assign(f.s.initial.size(), 0.1);
    for (std::size_t i = 0; i < 64; ++i)
      frame.temperature[i] -= (i / 16 % 2 == 0 ? 1.0 : -1.0) * 4.0 * std::exp(-0.7 * frame.time);
  }
  const auto v = value(f, metric("decay_rate", "final", "left"), {{"decay_rate", 0.5}}, m);
  EXPECT_NEAR(v.value, 0.4, 1e-9) << v.note;
  EXPECT_NEAR(v.uncertainty.statistical, (0.5 * 0.1 / 4.0 + 0.5 * 0.1 / (4.0 * std::exp(-0.7))) / 0.5 / 0.5,
              1e-9);
  for (auto& T : f.run.frames.back().temperature) T = 600.0 - T;
  EXPECT_NE(value(f, metric("decay_rate", "final", "left"), {{"decay_rate", 0.5}}, m)
                .note.find("of its first sign at t = 1.0"),
            std::string::npos);
}

/// A quarter of a cosine has a mean: warmth that is the same everywhere, and rises, is none of the mode.
TEST(KnownEvents, OfAModeOnAWarmingBarIsItsRateAlone) {
  auto f = still_blocks(4);
  Measuring m;
  m.wave = MeasuredWave{{0.5 * pi / 0.4, 0, 0}, 0.1, {}};
  for (auto& frame : f.run.frames)
    for (const Vec3& r : f.s.initial.position)
      frame.temperature.push_back(300.0 + 5.0 * frame.time +
                                  4.0 * std::exp(-0.7 * frame.time) * std::cos(0.5 * pi / 0.4 * r.x + 0.1));
  for (const char* body : {"left", "right", ""})
    EXPECT_NEAR(value(f, metric("decay_rate", "final", body), {{"decay_rate", 0.5}}, m).value, 0.4, 1e-9)
        << body;
}

// --- heat

/// Layers of the left block at -0.35, -0.25, -0.15 and -0.05 m that hold 0, 4, 0, 0 K above 300 K and then 1,
/// 2, 1, 0.
Still spreading(double pattern) {
  auto f = still_blocks(1);
  const double warm[2][4] = {{0, 4, 0, 0}, {1, 2, 1, 0}};
  for (std::size_t n = 0; n < 2; ++n) {
    auto& frame = f.run.frames[n];
    frame.temperature.assign(f.s.initial.size(), 300.0);
    frame.temperature_error.assign(f.s.initial.size(), 0.0);
    for (std::size_t i = 0; i < 64; ++i)
      frame.temperature[i] += warm[n][i / 16] * (1.0 + (i % 2 == 0 ? pattern : -pattern));
    for (std::size_t i = 0; i < 16; ++i) frame.temperature_error[i] = n == 0 ? 0.0 : 0.1;
  }
  return f;
}

TEST(KnownHeat, SpreadsByTwiceItsDiffusivityASecond) {
  for (const double pattern : {0.0, 0.5}) {
    const auto f = spreading(pattern);
    const auto v = value(f, metric("diffusivity", "final", "left"),
                         {{"value", 300.0}, {"diffusivity", 0.002}}, along(0));
    EXPECT_NEAR(v.value, 0.5 * 0.005 - 0.002, 1e-12) << v.note;
    // (0.1^2 - 0.005)/(64 K of particles) for each kelvin in the first layer; its 16 particles are one count,
    // or 16
    const double shared = 0.005 / 64.0 * 1.6, single = 0.005 / 64.0 * 0.4;
    EXPECT_NEAR(v.uncertainty.statistical, 0.5 * (pattern == 0.0 ? shared : single), 1e-12);
  }
  auto cold = spreading(0.0);
  for (auto& T : cold.run.frames.back().temperature) T = 300.0;
  EXPECT_TRUE(std::isnan(value(cold, metric("diffusivity", "final", "left"),
                               {{"value", 300.0}, {"diffusivity", 0.002}}, along(0))
                             .value));
}

/// Simpson's rule is exact for a cubic: the mean of 4 t^3 over 1 s is 1.
TEST(KnownHeat, GivenIsComparedWithTheMeanOfTheTruePower) {
  auto f = still_blocks();
  for (auto& frame : f.run.frames) frame.heat_given["left"] = 20.0 + 3.0 * frame.time;
  Known truth(f.run.frames.front(), {});
  truth.in_time = [](double t) { return 4.0 * t * t * t; };
  truth.deviation = [](double t) { return 0.25 * t; };
  const auto of = [&](std::array<double, 2> window) {
    auto choice = metric("heat_power", "final", "left");
    choice.window = window;
    return evaluate(choice, f.s.job, f.s.initial, f.run, truth);
  };
  EXPECT_NEAR(of({0.0, 1.0}).value, 3.0 - 1.0, 1e-12);
  EXPECT_NEAR(of({0.5, 1.0}).value, 3.0 - (1.0 - 0.0625) / 0.5, 1e-12);
  EXPECT_NEAR(of({0.5, 1.0}).uncertainty.data, 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(of({0.5, 0.5}).value));
  f.run.frames.back().heat_given.clear();
  EXPECT_NE(of({0.0, 1.0}).note.find("does not count the heat of `left`"), std::string::npos);
}

/// Layers of 16 whose mean is 1 K off; even particles have a standard error of 0.4 K and odd ones of 0.2 K.
TEST(KnownHeat, OfALayerIsKnownAsItsParticlesAreOrAsTheirOneCount) {
  auto s = test::blocks();
  for (double& m : s.initial.mass) m = 0.9765625;  // a volume of 2^-10: sums of it are exact
  for (const Vec3& r : s.initial.position) s.initial.temperature.push_back(300.0 + 100.0 * r.x);
  Still f(s);
  for (auto& frame : f.run.frames) frame.temperature = s.initial.temperature;
  const Known truth(f.run.frames.front(), {}, along(0));
  auto& last = f.run.frames.back();
  const auto chi = [&] {
    return evaluate(metric("temperature_profile", "chi", "left"), f.s.job, f.s.initial, f.run, truth).value;
  };
  for (std::size_t i = 0; i < last.temperature.size(); ++i) {
    last.temperature[i] += i % 2 == 0 ? 3.0 : -1.0;
    last.temperature_error.push_back(i % 2 == 0 ? 0.4 : 0.2);
  }
  EXPECT_NEAR(chi(), std::sqrt(160.0), 1e-9);  // variance (8 x 0.16 + 8 x 0.04)/16^2
  for (std::size_t i = 0; i < last.temperature.size(); ++i) {
    last.temperature[i] = 301.0 - 25.0 * static_cast<double>(3 - i / 16 % 4);
    last.temperature_error[i] = 0.5;
  }
  Snapshot steps = f.run.frames.front();
  for (std::size_t i = 0; i < steps.temperature.size(); ++i) steps.temperature[i] = last.temperature[i] - 1.0;
  const Known same(steps, {}, along(0));
  EXPECT_NEAR(evaluate(metric("temperature_profile", "chi", "left"), f.s.job, f.s.initial, f.run, same).value,
              2.0, 1e-9);
}

// --- an audit

using MiddleChange = std::function<void(Still&, Snapshot& middle)>;

TEST(KnownFaults, AreNamedWithParticleAndTime) {
  const std::vector<std::pair<std::string, MiddleChange>> faults{
      {"", [](Still&, Snapshot&) {}},
      {"position of particle 3 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.position[3].y = not_a_number; }},
      {"velocity of particle 5 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.velocity[5].z = not_a_number; }},
      {"temperature of particle 7 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.temperature.assign(136, 1.0);
         s.temperature[7] = not_a_number;
       }},
      {"temperature_error of particle 0 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.temperature_error.assign(136, 1.0);
         s.temperature_error[0] = not_a_number;
       }},
      {"density of particle 135 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.density.assign(136, 1.0);
         s.density[135] = not_a_number;
       }},
      {"pressure of particle 1 is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.pressure.assign(136, 1.0);
         s.pressure[1] = not_a_number;
       }},
      {"velocity of `right` is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.bodies[1].velocity.x = not_a_number; }},
      {"position of `left` is not finite at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.bodies[0].position.x = not_a_number; }},
      {"particle 9 is lost at t = 0.500000 s", [](Still&, Snapshot& s) { s.id[9] = -1; }},
      {"masses are missing at t = 0.500000 s", [](Still&, Snapshot& s) { s.mass.pop_back(); }},
      {"", [](Still&, Snapshot& s) { s.mass.clear(); }},
      {"the mass of particle 2 has changed at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.mass[2] *= 1.0 + 1.2e-12; }},
      {"", [](Still&, Snapshot& s) { s.mass[2] *= 1.0 - 0.8e-12; }},
      {"body row 1 is 0.000110 m from the centre of its particles at t = 0.500000 s",
       [](Still&, Snapshot& s) { s.bodies[1].position.z += 1.1e-4; }},
      {"contradicts itself: `right` moves otherwise than its velocity says from t = 0.250000 to 0.500000 s: "
       "by 0.00036 m/s, "
       "where "
       "4e-07 m/s may be",
       [](Still&, Snapshot& s) { s.bodies[1].position.z += 0.9e-4; }},
      {"body row 0 moves otherwise than its particles, by 1.000000 m/s at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.bodies[0].velocity = {0, 1, 0};
       }},
      {"",
       [](Still& f, Snapshot& s) {
         s.velocity[64] = {0, 0, 64.0};
         s.bodies[1].velocity = {0, 0, 1.05};
         (void)f;
       }},
      {"body row 1 moves otherwise than its particles, by 0.070000 m/s at t = 0.500000 s",
       [](Still&, Snapshot& s) {
         s.velocity[64] = {0, 0, 64.0};
         s.bodies[1].velocity = {0, 0, 1.07};
       }},
      {"", [](Still& f, Snapshot&) { f.run.frames[0].position[4].x += 0.9e-7; }},
      {"the first frame is not the job's start: particle 4 is elsewhere (other units, permuted ids or a "
       "shifted time?)",
       [](Still& f, Snapshot&) { f.run.frames[0].position[4].x += 1.1e-7; }}};
  for (const auto& [says, change] : faults) {
    Still f(test::blocks());
    for (auto& frame : f.run.frames)  // nothing is kept that a run of a still scene would not show
      for (std::size_t b = 0; b < 2; ++b) frame.bodies[b].position = f.s.job.bodies[b].properties.centre;
    change(f, f.run.frames[2]);
    EXPECT_EQ(audit(f.s.job, f.s.initial, f.run), says);
  }
}

/// Where a frame has no ids, none is dead: what lies behind the empty list is nobody's.
TEST(KnownFaults, OfAFrameWithoutIdsAreThoseOfAll) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames)
    for (int& id : frame.id) id = -1;
  for (auto& frame : f.run.frames) frame.id.clear();
  EXPECT_EQ(audit(f.s.job, f.s.initial, f.run), "");
  f.run.frames[2].position[0].x = not_a_number;
  EXPECT_EQ(audit(f.s.job, f.s.initial, f.run), "position of particle 0 is not finite at t = 0.500000 s");
}

TEST(KnownFaults, WhatIsNotAliveHasNeitherMassNorMotion) {
  auto f = still_blocks();
  auto& last = f.run.frames.back();
  last.velocity[3] = {0, 30, 40};
  last.position[3].z += 7.0;
  last.mass[3] = 9.0;
  last.id[3] = -1;
  const double height = f.s.initial.position[3].z;
  for (const auto& [quantity, figure] :
       {std::pair{"ledger.kinetic", 0.0}, std::pair{"ledger.potential", -10.0 * height},
        std::pair{"mass", -1.0}, std::pair{"momentum", 0.0}, std::pair{"energy", -10.0 * height}})
    EXPECT_NEAR(value(f, metric(quantity, "final")).value, figure, 1e-12) << quantity;
}

}  // namespace
}  // namespace tripoint
