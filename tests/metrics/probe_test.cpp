// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/gauge_error.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "metrics/frames.hpp"
#include "validation/audit/audit.hpp"
#include "validation/metrics/dominant_frequency.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Still;

/// Blocks whose scalars are linear in place: T = 300 + 20 x - 5 z, p = 100 y, rho = 1000 + x, v = (y, 2 z, 3
/// x).
Still linear_fields() {
  Still f(test::blocks());
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
      const Vec3 r = frame.position[i];
      frame.temperature.push_back(300.0 + 20.0 * r.x - 5.0 * r.z);
      frame.pressure.push_back(100.0 * r.y);
      frame.density.push_back(1000.0 + r.x);
      frame.velocity[i] = {r.y, 2.0 * r.z, 3.0 * r.x};
    }
  return f;
}

Settings at(double x, double y, double z, double value, const std::string& axis = "") {
  Settings args{{"point", std::vector<double>{x, y, z}}, {"value", value}};
  if (!axis.empty()) args["axis"] = axis;
  return args;
}

TEST(Probe, ReadsALinearFieldExactlyAlsoAtASurface) {
  const Still f = linear_fields();
  for (const Vec3& r : {Vec3{0.2, 0.2, 0.2}, Vec3{0.4, 0.17, 0.33}, Vec3{-0.4, 0.0, 0.0}}) {
    EXPECT_NEAR(
        f.stated(metric("temperature_at", "final"), at(r.x, r.y, r.z, 300.0 + 20.0 * r.x - 5.0 * r.z)), 0.0,
        1e-9);
    EXPECT_NEAR(f.stated(metric("pressure_at", "final"), at(r.x, r.y, r.z, 0.0)), 100.0 * r.y, 1e-9);
    EXPECT_NEAR(f.stated(metric("density_at", "final"), at(r.x, r.y, r.z, 1000.0)), r.x, 1e-9);
    EXPECT_NEAR(f.stated(metric("velocity_at", "final"), at(r.x, r.y, r.z, 0.0, "z")), 3.0 * r.x, 1e-9);
  }
}

/// A scalar that is curved is read as its weighted mean where all lies symmetrically: w = (1 - q)^2 (1 + 2 q)
/// to 2.5 spacings.
TEST(Probe, WeighsWhatItSeesByDistance) {
  Still f = linear_fields();
  const Vec3 middle{0.0, 0.2, 0.2};
  auto& last = f.run.frames.back();
  double weights = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 0; i < last.position.size(); ++i) {
    const Vec3 d = last.position[i] - middle;
    const double q = norm(d) / 0.25;
    last.temperature[i] = 300.0 + 1000.0 * d.x * d.x;
    if (q >= 1.0) continue;
    const double w = (1.0 - q) * (1.0 - q) * (1.0 + 2.0 * q);
    weights += w;
    weighted += w * last.temperature[i];
  }
  EXPECT_GT(weighted / weights, 305.0);
  EXPECT_NEAR(f.stated(metric("temperature_at", "final"), at(0.0, 0.2, 0.2, weighted / weights)), 0.0, 1e-9);
}

TEST(Probe, TakesTheNamedBodyAndTheStatedPhaseOnly) {
  Still f = linear_fields();
  auto& last = f.run.frames.back();
  for (std::size_t i = 0; i < last.position.size(); ++i)
    if (f.s.initial.source[i] == 1) last.temperature[i] += 1000.0;
  EXPECT_NEAR(f.stated(metric("temperature_at", "final", "left"), at(0.0, 0.2, 0.2, 299.0)), 0.0, 1e-9);
  EXPECT_NEAR(f.stated(metric("temperature_at", "final", "right"), at(0.0, 0.2, 0.2, 1299.0)), 0.0, 1e-9);
  auto liquid = at(0.0, 0.2, 0.2, 299.0);
  liquid["phase"] = std::string("liquid");
  EXPECT_NE(f.of(metric("temperature_at", "final"), "stated", liquid)
                .note.find("no particle that the metric takes"),
            std::string::npos);
}

TEST(Probe, IsComparedWithAFormulaAtItsPlaceAndItsTime) {
  const Still f = linear_fields();
  const Settings args{{"point", std::vector<double>{0.1, 0.2, 0.3}},
                      {"temperature", std::string("300 + 20*x - 5*z + 8*t")}};
  EXPECT_NEAR(f.of(metric("temperature_at", "final"), "expression", args).value, -8.0, 1e-9);
  EXPECT_NEAR(f.of(metric("temperature", "L2"), "expression",
                   {{"temperature", std::string("300 + 20*x - 5*z + 8*t")}})
                  .value,
              8.0, 1e-9);
  EXPECT_NEAR(f.of(metric("mean_temperature", "final", "left"), "expression",
                   {{"temperature", std::string("290 + 20*x - 5*z")}})
                  .value,
              10.0, 1e-9);
  EXPECT_NEAR(
      f.of(metric("mean_temperature", "final", "left"), "expression", {{"value", std::string("290 + 2*t")}})
          .value,
      300.0 - 4.0 - 1.0 - 292.0, 1e-9);
}

TEST(Probe, SaysWhatItNeeds) {
  const Still f = linear_fields();
  const auto note = [&](const char* quantity, const Settings& args) {
    return f.of(metric(quantity, "final"), "stated", args).note;
  };
  EXPECT_NE(note("temperature_at", {{"value", 300.0}}).find("needs the probe's place"), std::string::npos);
  EXPECT_NE(note("velocity_at", at(0.2, 0.2, 0.2, 0.0)).find("needs its axis"), std::string::npos);
  EXPECT_NE(note("displacement", {{"value", 0.0}}).find("needs a place at the start and an axis"),
            std::string::npos);
  EXPECT_NE(note("centre", {{"value", 0.0}}).find("needs an axis"), std::string::npos);
  EXPECT_NE(note("temperature_at", {{"point", std::vector<double>{0.2, 0.2, 0.2}}}).find("states no value"),
            std::string::npos);
  EXPECT_NE(Still(test::blocks())
                .of(metric("temperature_at", "final"), "stated", at(0.2, 0.2, 0.2, 0.0))
                .note.find("has no temperature"),
            std::string::npos);
}

TEST(Mean, IsOverTheStatedBoxByVolume) {
  const Still f = linear_fields();
  const Settings box{
      {"min", std::vector<double>{0, 0, 0}}, {"max", std::vector<double>{0.2, 0.4, 0.4}}, {"value", 300.0}};
  EXPECT_NEAR(f.stated(metric("mean_temperature", "final"), box), 20.0 * 0.1 - 5.0 * 0.2, 1e-9);
  auto pressed = box;
  pressed["value"] = 0.0;
  EXPECT_NEAR(f.stated(metric("mean_pressure", "final"), pressed), 20.0, 1e-9);
  EXPECT_NEAR(f.stated(metric("mean_density", "final"), pressed), 1000.1, 1e-9);
  pressed["axis"] = std::string("y");
  EXPECT_NEAR(f.stated(metric("mean_velocity", "final"), pressed), 0.4, 1e-9);
  pressed["outside"] = true;
  EXPECT_NEAR(f.stated(metric("mean_velocity", "final", "right"), pressed), 0.4, 1e-9);
  const Settings nowhere{
      {"min", std::vector<double>{7, 7, 7}}, {"max", std::vector<double>{8, 8, 8}}, {"value", 0.0}};
  EXPECT_NE(f.of(metric("mean_temperature", "final"), "stated", nowhere)
                .note.find("no particle that the metric takes lies in the region"),
            std::string::npos);
}

TEST(Extreme, IsThatOfTheParticlesInTheBox) {
  const Still f = linear_fields();
  double least = INFINITY, most = -INFINITY;
  for (const double T : f.run.frames.back().temperature) {
    least = std::min(least, T);
    most = std::max(most, T);
  }
  EXPECT_NEAR(f.stated(metric("greatest_temperature", "final"), {{"value", most}}), 0.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("least_temperature", "final"), {{"value", least}}), 0.0, 1e-12);
  EXPECT_LT(f.stated(metric("greatest_temperature", "final"), {{"value", most},
                                                               {"min", std::vector<double>{-9, -9, -9}},
                                                               {"max", std::vector<double>{0, 9, 9}}}),
            0.0);
}

/// A lattice has its depth wherever the gauge stands.
TEST(Depth, IsVolumeByArea) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames)
    for (std::size_t i = 0; i < frame.phase.size(); ++i)
      frame.phase[i] = static_cast<int>(frame.position[i].z < 1.0 ? Phase::liquid : Phase::rigid);
  for (const double x : {-0.01, 0.0, 0.013})
    EXPECT_NEAR(f.stated(metric("depth_at", "final"), at(x, 0.2, 0.0, 0.4)), 0.0, 1e-12) << x;
}

/// In two dimensions a particle's mass is that of a layer 1 m deep, and the gauge stands anywhere along y.
TEST(Depth, OfALayerIsAreaByLength) {
  test::Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.dimensions = 2;
  test::add_matter(s, "pool", Phase::liquid, {{8, 1, 4}, 0.1, {-0.4, -0.05, 0.0}, 1.0}, {}, 1000.0);
  for (double& m : s.initial.mass) m = 1000.0 * 0.1 * 0.1;  // times 1 m
  test::set_times(s, 1.0, 4);
  const Still f(std::move(s));
  for (const double x : {-0.01, 0.0, 0.013})
    for (const double y : {0.0, 0.5})
      EXPECT_NEAR(f.stated(metric("depth_at", "final"), at(x, y, 0.0, 0.4)), 0.0, 1e-12) << x << ", " << y;
}

TEST(Displacement, FollowsAPointOfMatter) {
  Still f(test::blocks());
  auto& last = f.run.frames.back();
  for (std::size_t i = 0; i < last.position.size(); ++i)
    last.position[i] += Vec3{0.1 * f.s.initial.position[i].x, 0.0, 0.02};
  EXPECT_NEAR(f.stated(metric("displacement", "final", "right"), at(0.4, 0.2, 0.2, 0.03, "x")), 0.01,
              1e-12);  // the end face, half a spacing beyond the particles
  EXPECT_NEAR(f.stated(metric("displacement", "final", "right"), at(0.4, 0.2, 0.2, 0.0, "z")), 0.02, 1e-12);
  EXPECT_NEAR(f.of(metric("centre", "final", "left"), "expression",
                   {{"axis", std::string("x")}, {"value", std::string("-0.2*t")}})
                  .value,
              -0.02, 1e-12);
}

TEST(Frequency, OfASeriesIsThatOfItsSine) {
  std::vector<double> t, pure, damped, bounces;
  for (int n = 0; n <= 200; ++n) {
    t.push_back(0.01 * n);
    pure.push_back(4.0 + 3.0 * std::sin(2.0 * test::pi * 2.37 * t.back() + 0.4));
    damped.push_back(std::exp(-0.3 * t.back()) * std::cos(2.0 * test::pi * 2.37 * t.back()));
    const double phase = std::fmod(2.37 * t.back(), 1.0) - 0.5;
    bounces.push_back(1.0 - 4.0 * phase * phase);
  }
  const auto exact = dominant_frequency(t, pure);
  EXPECT_NEAR(exact.frequency, 2.37, 1e-6);
  EXPECT_NEAR(exact.amplitude, 3.0, 1e-6);
  EXPECT_LT(exact.uncertainty, 1e-5);
  for (const auto* y : {&damped, &bounces}) {
    const auto found = dominant_frequency(t, *y);
    EXPECT_NEAR(found.frequency, 2.37, 0.01);
    EXPECT_NEAR(found.frequency, 2.37, 4.0 * found.uncertainty);
  }
}

TEST(Frequency, IsRefusedWhereThereIsNone) {
  std::vector<double> t, flat, ramp, slow;
  for (int n = 0; n <= 100; ++n) {
    t.push_back(0.01 * n);
    flat.push_back(5.0);
    ramp.push_back(t.back());
    slow.push_back(std::sin(2.0 * test::pi * 0.8 * t.back()));
  }
  EXPECT_NE(dominant_frequency(t, flat).problem.find("does not change"), std::string::npos);
  EXPECT_NE(dominant_frequency({0, 1, 2}, {1, 2, 1}).problem.find("eight output times"), std::string::npos);
  for (const auto* y : {&ramp, &slow}) EXPECT_FALSE(dominant_frequency(t, *y).problem.empty());
}

TEST(Frequency, IsANormOfAnySingleNumber) {
  auto prepared = test::blocks();
  test::set_times(prepared, 2.0, 200);
  Still f(std::move(prepared));
  for (auto& frame : f.run.frames)
    f.shift(frame, 1, {0.0, 0.0, 0.01 * std::sin(2.0 * test::pi * 3.0 * frame.time)});
  const Settings args{{"axis", std::string("z")}, {"frequency", 2.5}};
  const auto v = f.of(metric("centre", "frequency", "right"), "stated", args);
  EXPECT_NEAR(v.value, 0.5, 1e-6) << v.note;
  EXPECT_LT(v.uncertainty.numerical, 1e-6);
  EXPECT_TRUE(std::isnan(f.of(metric("position", "frequency"), "stated", args).value));
  EXPECT_NE(f.of(metric("centre", "frequency", "right"), "stated", {{"axis", std::string("z")}})
                .note.find("needs the true one in Hz"),
            std::string::npos);
  EXPECT_NE(f.of(metric("position", "frequency"), "stated", args).note.find("single number"),
            std::string::npos);
}

/// A bar that warms by 2 K a second beside a held block.
Still warming() {
  auto s = test::blocks();
  for (auto& m : s.job.scene.materials) {
    m.conductivity = 1.0;
    m.heat_capacity = 500.0;
  }
  s.job.bodies[1].temperature_held = true;
  Still f(std::move(s));
  for (auto& frame : f.run.frames)
    for (const int source : f.s.initial.source)
      frame.temperature.push_back(source == 1 ? 400.0 : source == 0 ? 300.0 + 2.0 * frame.time : 300.0);
  return f;
}

TEST(HeatPower, IsThatOfTheLedgerOfTheEngineOrOfTheOnlyHeldBody) {
  Still f = warming();
  const auto power = [&](const char* body, double value) {
    return f.of(metric("heat_power", "final", body), "stated", {{"value", value}});
  };
  EXPECT_NEAR(power("right", 60000.0).value, 4000.0, 1e-6);  // 64 kg, 500 J/kg/K, 2 K/s
  EXPECT_NE(power("left", 0.0).note.find("is not the only one that brings heat"), std::string::npos);
  for (auto& frame : f.run.frames) frame.heat_given["right"] = 7.0 * frame.time * frame.time;
  EXPECT_NEAR(power("right", 0.0).value, 7.0, 1e-12);
  EXPECT_NEAR(
      f.of(metric("heat_power", "final", "right"), "expression", {{"value", std::string("14*t")}}).value, 0.0,
      1e-9);
  EXPECT_THROW((void)f.of(metric("heat_power", "final"), "stated", {{"value", 0.0}}), InputError);
}

/// Heat at both ends of a row and in its middle: of shares a, 1 - 2 a and a the mean square distance is 2 a
/// d^2.
TEST(Diffusivity, IsHalfOfWhatTheMeanSquareDistanceOfHeatGrowsASecond) {
  Still f(test::blocks());
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < f.s.initial.size(); ++i)
    if (f.s.initial.source[i] == 0) {
      low = std::min(low, f.s.initial.position[i].x);
      high = std::max(high, f.s.initial.position[i].x);
    }
  // Of the two ends; the rest at the two layers beside the middle
  const auto heat = [&](Snapshot& frame, double share) {
    frame.temperature.assign(frame.position.size(), 300.0);
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
      const double off = std::abs(frame.position[i].x - 0.5 * (low + high));
      if (f.s.initial.source[i] == 0 && off > 0.45 * (high - low)) frame.temperature[i] += share;
      if (f.s.initial.source[i] == 0 && off < 0.2 * (high - low)) frame.temperature[i] += 1.0 - share;
    }
  };
  for (auto& frame : f.run.frames) heat(frame, 0.0);
  heat(f.run.frames.back(), 0.25);
  const double end = std::pow(0.5 * (high - low), 2), inner = std::pow((high - low) / 6.0, 2);  // four layers
  const double D = 0.5 * 0.25 * (end - inner) / (f.run.frames.back().time - f.run.frames.front().time);
  const auto value = [&](double truth, const std::string& axis = "x") {
    return f.of(metric("diffusivity", "final", "left"), "stated",
                {{"axis", axis}, {"value", 300.0}, {"diffusivity", truth}});
  };
  EXPECT_NEAR(value(D).value, 0.0, 1e-12);
  EXPECT_NEAR(value(D / 1.02).value, 0.02 * D / 1.02, 1e-12) << "2 % are seen";
  EXPECT_NEAR(value(D, "y").value, -D, 1e-12);
  EXPECT_EQ(value(D).uncertainty.statistical, 0.0);
  for (auto& frame : f.run.frames) frame.temperature_error.assign(frame.temperature.size(), 0.01);
  EXPECT_GT(value(D).uncertainty.statistical, 0.0);
  EXPECT_NE(
      f.of(metric("diffusivity", "final", "left"), "stated", {{"value", 300.0}}).note.find("needs its axis"),
      std::string::npos);
}

TEST(Gauge, TheEnginesOwnNumberGoesBeforeItsParticles) {
  Still f = linear_fields();
  const auto choice = metric("temperature_at", "final");
  const double read = f.stated(choice, at(0.2, 0.2, 0.2, 0.0));
  for (auto& frame : f.run.frames) frame.gauges[choice.name] = read + 5.0 + frame.time;
  EXPECT_NEAR(f.stated(choice, at(0.2, 0.2, 0.2, read)), 6.0, 1e-9);
  EXPECT_NEAR(f.stated(metric("temperature_at", "drift"), at(0.2, 0.2, 0.2, 0.0)), 1.0, 1e-9);
}

TEST(Gauge, OfADiffusivityIsTheEnginesOwnAtTheEndWithItsStandardError) {
  Still f(test::blocks());
  const auto choice = metric("diffusivity", "final", "left");
  f.run.frames.back().gauges[choice.name] = 1.02e-6;
  EXPECT_NEAR(f.of(choice, "stated", {{"diffusivity", 1e-6}}).value, 0.02e-6, 1e-18);
  EXPECT_EQ(f.of(choice, "stated", {{"diffusivity", 1e-6}}).uncertainty.statistical, 0.0);
  f.run.frames.back().gauges[gauge_error_key(choice.name)] = 1e-9;
  EXPECT_EQ(f.of(choice, "stated", {{"diffusivity", 1e-6}}).uncertainty.statistical, 1e-9);
  EXPECT_NE(f.of(choice, "stated", {}).note.find("needs its true value"), std::string::npos);
}

TEST(Gauge, ItsStandardErrorIsAnUncertaintyOfTheValue) {
  Still f = linear_fields();
  const auto choice = metric("temperature_at", "final");
  for (auto& frame : f.run.frames) {
    frame.gauges[choice.name] = 300.0;
    frame.gauges[gauge_error_key(choice.name)] = 0.5;
  }
  // What the largest of two samples is off in the mean: the norm takes at least two
  const double largest = std::sqrt(2.0 * std::log(2.0));
  EXPECT_NEAR(f.of(choice, "stated", at(0.2, 0.2, 0.2, 300.0)).uncertainty.statistical, 0.5 * largest, 1e-12);
}

TEST(Gauge, AnEngineWithoutParticlesIsJudgedByItsGaugesAlone) {
  Still f(test::blocks());
  const auto choice = metric("displacement", "final", "left");
  for (auto& frame : f.run.frames) {
    const double time = frame.time;
    frame = Snapshot{};
    frame.time = time;
    frame.gauges[choice.name] = 0.1 * time;
  }
  EXPECT_EQ(audit(f.s.job, f.s.initial, f.run), "");
  EXPECT_NEAR(f.stated(choice, at(0.0, 0.2, 0.2, 0.04, "x")), 0.06, 1e-15);
  for (const char* quantity : {"position", "velocity", "momentum", "temperature"})
    EXPECT_NE(f.of(metric(quantity, "final"), "stated", {}).note.find("shows no particles"),
              std::string::npos)
        << quantity;
  auto other = choice;
  other.name = "another";
  EXPECT_NE(f.of(other, "stated", at(0.0, 0.2, 0.2, 0.0, "x")).note.find("no gauge of this metric"),
            std::string::npos);
}

}  // namespace
}  // namespace tripoint
