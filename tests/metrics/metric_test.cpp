// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <random>

#include "metrics/fakes.hpp"
#include "validation/metrics/frame_error.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Trial;

TEST(Metric, IsNothingForThePerfectRun) {
  const Trial flight(test::thrown_block(), "torque_free"), heat(test::warm_bar(), "cosine_mode");
  for (const char* q :
       {"position", "velocity", "orientation", "angular_velocity", "body_count", "phase_count", "momentum",
        "angular_momentum", "energy", "mass", "force", "ledger.kinetic"})
    for (const char* norm : {"max", "rms", "final"})
      EXPECT_LT(std::abs(flight.value(metric(q, norm)).value), 1e-15) << q << ' ' << norm;
  for (const char* q : {"temperature", "temperature_profile"})
    for (const char* norm : {"L1", "L2", "Linf", "L2raw", "max", "rms"})
      EXPECT_EQ(heat.value(metric(q, norm)).value, 0.0) << q << ' ' << norm;
  EXPECT_LT(std::abs(heat.value(metric("decay_rate", "final")).value), 1e-12);
  EXPECT_LT(std::abs(heat.value(metric("front", "final")).value), 1e-12);
}

TEST(Metric, EachNormIsExplainedByItsOwnWord) {
  ASSERT_EQ(metric_norms().size(), all_of<Norm>().size());
  for (const Norm norm : all_of<Norm>())
    EXPECT_EQ(metric_norms()[static_cast<std::size_t>(norm)].name, to_string(norm));
}

TEST(Metric, MeasuresAKnownShift) {
  Trial t(test::thrown_block(), "torque_free");
  for (auto& r : t.run.frames.back().position) r += Vec3{0.003, 0, 0.004};
  t.run.frames.back().bodies[0].position += Vec3{0, 0.25, 0};
  EXPECT_NEAR(t.value(metric("position", "max")).value, 0.005, 1e-12);
  EXPECT_NEAR(t.value(metric("position", "Linf")).value, 0.005, 1e-12);
  EXPECT_NEAR(t.value(metric("position", "max", "block")).value, 0.25, 1e-12);
  // sqrt(integral e^2 dt / T) of a last frame alone, trapezoidal: half an interval of ten.
  EXPECT_NEAR(t.value(metric("position", "rms")).value, 0.005 * std::sqrt(0.05), 1e-12);
  auto scaled = metric("position", "final");
  scaled.scale = 0.1;
  EXPECT_NEAR(t.value(scaled).value, 0.05, 1e-11);
}

TEST(Metric, TakesTheNearestImageInAPeriodicDirection) {
  Trial t(test::thrown_block(), "torque_free");
  t.s.job.scene.periodic = {true, false, false};
  t.s.job.scene.min = Vec3{-2, -2, -2};
  t.s.job.scene.max = Vec3{2, 2, 2};
  for (auto& r : t.run.frames.back().position) r.x -= 4.0;
  EXPECT_LT(t.value(metric("position", "max")).value, 1e-12);
}

TEST(Metric, WeighsTemperaturesByVolume) {
  Trial t(test::warm_bar(), "cosine_mode");
  auto& T = t.run.frames.back().temperature;
  for (std::size_t i = 0; i < T.size(); ++i) T[i] += i % 2 == 0 ? 0.2 : 0.0;
  EXPECT_NEAR(t.value(metric("temperature", "L1")).value, 0.1, 1e-12);
  EXPECT_NEAR(t.value(metric("temperature", "L2")).value, 0.2 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(t.value(metric("temperature", "Linf")).value, 0.2, 1e-12);
  // The even ones count three times
  for (std::size_t i = 0; i < T.size(); i += 2) t.s.initial.mass[i] *= 3.0;
  EXPECT_NEAR(t.value(metric("temperature", "L1")).value, 0.15, 1e-12);
}

TEST(Metric, FindsTheAngleBlindToTheQuaternionsSign) {
  Trial t(test::thrown_block(), "torque_free");
  auto& q = t.run.frames.back().bodies[0].orientation;
  q = {-q.w, -q.x, -q.y, -q.z};
  EXPECT_LT(t.value(metric("orientation", "final", "block")).value, 1e-15);
  q = from_rotation_vector({0, 0, 0.01}) * q;
  EXPECT_NEAR(t.value(metric("orientation", "final", "block")).value, 0.01, 1e-12);
}

TEST(Metric, FindsARateThatIsTwoPercentOff) {
  Trial t(test::warm_bar(), "cosine_mode");
  auto other = t.s;
  other.job.scene.materials[0].conductivity = 2.04;
  t.run = test::perfect_run(other, *make_reference(test::function("cosine_mode"), other.job, other.initial));
  EXPECT_NEAR(t.value(metric("decay_rate", "final")).value, 0.02, 1e-10);
  EXPECT_NEAR(t.value(metric("decay_rate", "max")).value, 0.02, 1e-10);
}

TEST(Metric, FindsFlipsBetweenFramesByTheBodysOwnRates) {
  auto s = test::block({0.01, 5, 0.01}, 13.0, 260);  // frames 50 ms apart; two flips
  Trial t(s, "flip_time");
  const auto found = t.value(metric("event_time", "final", "block"));
  EXPECT_LT(std::abs(found.value), 1e-6) << found.note;  // (interval)^4 of a cubic
  EXPECT_EQ(t.value(metric("event_count", "final")).value, 0.0);
  for (auto& f : t.run.frames)
    if (f.time > 10.0) f.bodies[0] = t.run.frames[180].bodies[0];  // never flips back
  EXPECT_EQ(t.value(metric("event_count", "final")).value, -1.0);
  auto lost = t;  // a run that never flips has no event time
  for (auto& f : lost.run.frames) f.bodies[0] = lost.run.frames[0].bodies[0];
  EXPECT_TRUE(std::isnan(lost.value(metric("event_time", "final")).value));
}

TEST(Metric, KeepsTheSignOfASingleNumberAtTheEnd) {
  Trial t(test::thrown_block(), "torque_free");
  for (auto& v : t.run.frames.back().velocity) v = 0.9 * v;
  EXPECT_LT(t.value(metric("ledger.kinetic", "final")).value, 0.0);
  EXPECT_GT(t.value(metric("ledger.kinetic", "max")).value, 0.0);
}

TEST(Metric, MeasuresDriftFromTheRunsOwnStart) {
  auto s = test::block({1, 2, 3}, 1.0, 10);
  Trial t(s, "torque_free");
  const auto invariant = make_reference(test::function("invariant"), t.s.job, t.s.initial);
  const auto drift = [&](const char* q, const char* body = "") {
    return evaluate(metric(q, "drift", body), t.s.job, t.s.initial, t.run, *invariant).value;
  };
  EXPECT_LT(drift("angular_momentum"), 1e-14);
  EXPECT_LT(drift("ledger.kinetic"), 1e-14);
  EXPECT_LT(drift("momentum"), 1e-14);
  EXPECT_EQ(drift("mass"), 0.0);
  EXPECT_GT(drift("orientation", "block"), 1.0);
  EXPECT_LT(evaluate(metric("shape", "max"), t.s.job, t.s.initial, t.run, *invariant).value, 1e-14);
  for (auto& r : t.run.frames.back().position) r = 1.01 * r;
  EXPECT_NEAR(evaluate(metric("shape", "max"), t.s.job, t.s.initial, t.run, *invariant).value, 0.01, 1e-12);
  EXPECT_TRUE(std::isnan(evaluate(metric("position", "max"), t.s.job, t.s.initial, t.run, *invariant).value));
}

TEST(Metric, SumsHeatAboveZeroKelvin) {
  Trial t(test::warm_bar(), "cosine_mode");
  double mass = 0.0;
  for (const double m : t.s.initial.mass) mass += m;
  EXPECT_LT(t.value(metric("ledger.thermal", "drift")).value, 1e-12 * mass * 1000.0 * 300.0);
  for (auto& T : t.run.frames.back().temperature) T += 0.5;
  EXPECT_NEAR(t.value(metric("ledger.thermal", "drift")).value, mass * 1000.0 * 0.5, 1e-9 * mass * 1000.0);
}

TEST(Metric, ShowsATrendOverTime) {
  Trial t(test::thrown_block(), "torque_free");
  for (auto& f : t.run.frames)
    for (auto& r : f.position) r.x += 0.02 * f.time;
  EXPECT_NEAR(t.value(metric("position", "slope")).value, 0.02, 1e-12);
}

// --- walkers

Trial noisy_bar(double bias, double sigma, unsigned seed, bool by_layers) {
  Trial t(test::warm_bar(), "cosine_mode");
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  for (auto& f : t.run.frames) {
    f.temperature_error.assign(f.temperature.size(), sigma);
    double e = 0.0;
    for (std::size_t i = 0; i < f.temperature.size(); ++i) {
      if (!by_layers || i % 16 == 0) e = noise(random);  // 4 x 4 particles a layer
      f.temperature[i] += bias + e;
    }
  }
  return t;
}

TEST(Walkers, HaveTheirOwnScatterTakenOffTheL2Error) {
  double corrected = 0.0, raw = 0.0;
  const int runs = 200;
  for (unsigned n = 0; n < runs; ++n) {
    const auto t = noisy_bar(0.3, 0.2, n, false);
    const double e = t.value(metric("temperature", "L2")).value;
    corrected += e * e / runs;
    raw += std::pow(t.value(metric("temperature", "L2raw")).value, 2) / runs;
  }
  EXPECT_NEAR(corrected, 0.09, 0.002);  // the true error alone: standard error 5e-4
  EXPECT_NEAR(raw, 0.09 + 0.04, 0.002);
}

TEST(Walkers, StateAnUncertaintyThatCoversTheTruthForManyAndForPooledCounts) {
  for (const bool by_layers : {false, true}) {
    int covered = 0;
    const int runs = 400;
    for (unsigned n = 0; n < runs; ++n) {
      const auto v = noisy_bar(0.3, 0.2, 1000 + n, by_layers).value(metric("temperature", "L2"));
      covered += std::abs(v.value - 0.3) <= 2.0 * v.uncertainty.statistical ? 1 : 0;
    }
    EXPECT_GT(covered, 0.92 * runs) << by_layers;  // k = 2
    EXPECT_LT(covered, 0.995 * runs) << by_layers;
  }
}

/// The mean of sixteen equal temperatures is not always that temperature, to the last bit.
TEST(Walkers, OfOneCountALayerAreOneSampleInAProfileToo) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto t = noisy_bar(0.3, 0.2, seed, true);
    const double pooled = t.value(metric("temperature", "L2")).uncertainty.statistical;
    EXPECT_NEAR(t.value(metric("temperature_profile", "L2")).uncertainty.statistical, pooled, 1e-12) << seed;
  }
}

TEST(Metric, GivesTheFirstParticleThatFlowsInNoVolumeOfTheStart) {
  auto s = test::thrown_block();
  const auto last = s.initial.size() - 1;
  s.initial.mass.push_back(7.0);
  // What lies behind the last is memory that a careless look would take for a particle
  s.initial.mass.pop_back();
  s.initial.material.push_back(0);
  s.initial.material.pop_back();
  const auto choice = metric("position", "max");
  const auto truth = make_reference(test::function("torque_free"), s.job, s.initial);
  const MetricInput in{choice, s.job, s.initial, *truth};
  EXPECT_GT(rest_volume(in, last), 0.0);
  EXPECT_EQ(rest_volume(in, last + 1), 0.0);
}

TEST(Walkers, AgreeWithTheTruthWhereTheErrorIsAllNoise) {
  const auto t = noisy_bar(0.0, 0.2, 5, false);
  const auto chi = t.value(metric("temperature", "chi"));
  EXPECT_NEAR(chi.value, 1.0, 4.0 * chi.uncertainty.statistical);
  EXPECT_NEAR(t.value(metric("temperature_error", "L2")).value, 0.2, 1e-12);
  const auto rate = t.value(metric("decay_rate", "final"));
  EXPECT_LT(std::abs(rate.value), 2.0 * rate.uncertainty.statistical);
  EXPECT_GT(rate.uncertainty.statistical, 0.0);
}

TEST(Metric, SaysTheUnitOfItsValueWhereTheCaseSaysNone) {
  auto choice = metric("ledger.residual", "max");
  EXPECT_EQ(unit_of_value(choice), "J");
  choice.unit = "of the heat";
  EXPECT_EQ(unit_of_value(choice), "of the heat");
  EXPECT_EQ(unit_of_value(metric("centre", "max", "ball")), "m");
  EXPECT_EQ(unit_of_value(metric("centre", "slope", "ball")), "1");
  choice = metric("centre", "max", "ball");
  choice.scale = 2.0;
  EXPECT_EQ(unit_of_value(choice), "1");
}

}  // namespace
}  // namespace tripoint
