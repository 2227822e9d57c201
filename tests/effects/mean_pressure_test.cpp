// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "effects/fluid_lab.hpp"
#include "liquids/fields.hpp"
#include "scene/shared_terms.hpp"

/// scene.mean_pressure and scene.sound_damping of liquid that the transport velocity moves (model 8.3).
namespace tripoint {
namespace {

constexpr double wave = 2.0 * std::numbers::pi;

struct Keys {
  double mean_pressure = 0.0, sound_damping = 0.0;
};

/// A periodic slab of liquid, `n` particles a wavelength of 1 m, at rest on its lattice.
lab::Lab slab(int n, const Keys& keys) {
  const double dx = 1.0 / n;
  constexpr int thick = 6;
  lab::Lab lab = lab::liquid_lab(dx, 1.0, 0.01, 100.0);
  lab.scene.modes[term::clamp] = Mode::paper;
  lab.scene.transport_velocity = true;
  lab.scene.values["core_reach"] = 0.0;
  lab.scene.values["mean_pressure"] = keys.mean_pressure;
  lab.scene.values["sound_damping"] = keys.sound_damping;
  lab.add({.name = "water",
           .corner = {0.5 * dx, 0.5 * dx, 0.0},
           .count = {n, thick, thick},
           .phase = Phase::liquid});
  lab.make_periodic({true, true, true}, {0.5 * dx, 0.5 * dx, 0.0}, {n, thick, thick});
  return lab;
}

/// Disordered, with velocities of a wave that both compresses and shears, in a frame that moves with
/// `stream`.
lab::Lab stirred(const Keys& keys, const Vec3& stream = {}) {
  lab::Lab lab = slab(10, keys);
  lab::jitter(lab, 0.3);
  lab::set_velocity(lab, [&](const Vec3& r) {
    return stream + Vec3{std::sin(wave * r.x), 0.5 * std::cos(wave * r.x), 0.2 * std::sin(2.0 * wave * r.x)};
  });
  return lab;
}

std::vector<Vec3> pressure_forces(const Simulation& s) { return lab::vectors_by_id(s, field::force); }

TEST(MeanPressure, AndTheDampingOfSoundKeepMomentumToRoundOff) {
  const lab::Lab lab = stirred({1.0, 0.2}, {0.7, -0.4, 0.2});
  Simulation s(lab.scene, lab.initial);
  const Vec3 before = s.ledger().momentum;
  s.advance_to(0.2);
  EXPECT_GT(s.steps(), 10);
  EXPECT_LT(norm(s.ledger().momentum - before), 1e-13 * norm(before));
}

TEST(MeanPressure, AndTheDampingOfSoundDoNotFeelAStream) {
  const lab::Lab at_rest = stirred({1.0, 0.2}), carried = stirred({1.0, 0.2}, {3.0, -2.0, 1.0});
  const auto a = pressure_forces(Simulation(at_rest.scene, at_rest.initial));
  const auto b = pressure_forces(Simulation(carried.scene, carried.initial));
  double most = 0.0;
  for (const Vec3& f : a) most = std::max(most, norm(f));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(norm(a[i] - b[i]), 1e-13 * most);
}

/// The power of its forces is -sum V q^2/(zeta rho0 c h), term by term what the divergence takes: never
/// positive.
TEST(DampingOfSound, TakesWhatTheRateOfTheNumberDensitySays) {
  constexpr double zeta = 0.2, c = 10.0;
  const lab::Lab quiet = stirred({}), damped = stirred({0.0, zeta});
  const Simulation without(quiet.scene, quiet.initial), with(damped.scene, damped.initial);
  const auto v = lab::velocities_by_id(with), damps = pressure_forces(with),
             presses = pressure_forces(without);
  const auto V = lab::by_id(with, field::volume), q = lab::by_id(with, field::bulk_pressure);
  double power = 0.0, taken = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    power += dot(damps[i] - presses[i], v[i]);
    taken += V[i] * q[i] * q[i] / (zeta * c * with.state().support());
  }
  EXPECT_GT(taken, 0.0);
  EXPECT_NEAR(power / taken, -1.0, 1e-11);
}

/// rms of what the mean takes off a wave of pressure, over the wave.
double smoothed(int n) {
  const auto wavy = [n](double mean_pressure) {
    lab::Lab lab = slab(n, {mean_pressure, 0.0});
    for (Vec3& r : lab.initial.position) r.x += 0.01 / wave * std::sin(wave * r.x);
    return lab::by_id(Simulation(lab.scene, lab.initial), field::pressure);
  };
  const auto own = wavy(0.0), mean = wavy(1.0);
  double middle = 0.0, off = 0.0, all = 0.0;
  for (const double p : own) middle += p / static_cast<double>(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    off += (mean[i] - own[i]) * (mean[i] - own[i]);
    all += (own[i] - middle) * (own[i] - middle);
  }
  return std::sqrt(off / all);
}

/// 1 - (k h)^2/30 of a wave passes Wendland's C2, whose second moment is h^2/15; at 48 particles a wavelength
/// (k h)^2 is 0.116.
TEST(MeanPressure, IsOfSecondOrderOverThreeLevels) {
  const double coarse = smoothed(12), middle = smoothed(24), fine = smoothed(48);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.06);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.25);
  const double kh = wave * 2.6 / 48.0;
  EXPECT_NEAR(fine / (kh * kh / 30.0), 1.0, 0.1);
}

TEST(MeanPressure, LeavesAnEvenPressureAsItIs) {
  const auto pressed = [](double mean_pressure) {
    lab::Lab lab = slab(10, {mean_pressure, 0.0});
    lab.scene.materials[0].density = 0.9;  // heavier than it should be by its own sum
    return lab::by_id(Simulation(lab.scene, lab.initial), field::pressure);
  };
  const auto own = pressed(0.0), mean = pressed(1.0);
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(mean[i], own[i], 1e-11);
}

}  // namespace
}  // namespace tripoint
