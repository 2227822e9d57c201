// SPDX-License-Identifier: BSD-3-Clause
#include "step/settle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "effects/lab.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.04, g = 9.81;
constexpr int across = 5, deep = 6;

/// Water on a floor, repeated sideways.
lab::Lab pond(double jitter = 0.1) {
  lab::Lab lab(dx);
  lab.scene.gravity = {0.0, 0.0, -g};
  lab.scene.settle = true;
  lab.scene.materials[0].stiffness = 100.0 * 2.0 * g * deep * dx;
  lab.make_periodic({true, true, false}, {}, {across, across, 1});
  lab.add({.name = "water", .count = {across, across, deep}, .phase = Phase::liquid});
  lab.add({.name = "floor",
           .corner = {0.0, 0.0, -3.0 * dx},
           .count = {across, across, 3},
           .motion = Motion::fixed});
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    if (lab.initial.body[i] < 0)
      lab.initial.position[i].x += jitter * dx * std::sin(7.0 * static_cast<double>(i));
  return lab;
}

/// Greatest rms speed of the water within the first half second, over sqrt(g H).
double unrest(const lab::Lab& lab, const InitialState& start) {
  Simulation s(lab.scene, start);
  double most = 0.0;
  s.advance_to(0.5, [&] {
    const auto v = velocities(s.state().particles);
    double sum = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) sum += dot(v.at(i), v.at(i));
    most = std::max(most, sum / (across * across * deep));
    return true;
  });
  return std::sqrt(most / (g * deep * dx));
}

TEST(Settle, LetsWaterStartAtRest) {
  const lab::Lab lab = pond();
  Settling how;
  const InitialState start = settled(lab.scene, lab.initial, &how);
  EXPECT_LT(how.speed, how.goal);
  EXPECT_GT(how.steps, 20);
  EXPECT_GT(unrest(lab, lab.initial), 0.04) << "what is laid must move, or this shows nothing";
  EXPECT_LT(unrest(lab, start), 0.01);
}

TEST(Settle, MovesLiquidsAlone) {
  const lab::Lab lab = pond();
  const InitialState start = settled(lab.scene, lab.initial);
  ASSERT_EQ(start.size(), lab.initial.size());
  EXPECT_EQ(start.velocity, lab.initial.velocity);
  EXPECT_EQ(start.mass, lab.initial.mass);
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (start.body[i] >= 0) {
      EXPECT_EQ(start.position[i], lab.initial.position[i]) << i;
    }
  }
}

TEST(Settle, GivesTheSameParticlesInBothModes) {
  lab::Lab lab = pond();
  const InitialState corrected = settled(lab.scene, lab.initial);
  lab.scene.mode = Mode::paper;
  lab.scene.set_all_modes(Mode::paper);
  EXPECT_EQ(settled(lab.scene, lab.initial).position, corrected.position);
}

TEST(Settle, EndsAtOnceWhenSomeoneWantsIt) {
  const lab::Lab lab = pond();
  stop_settling_when([]() noexcept { return true; });
  EXPECT_THROW((void)settled(lab.scene, lab.initial), SettlingStopped);
  stop_settling_when([]() noexcept { return false; });
  EXPECT_NO_THROW((void)settled(lab.scene, lab.initial));
  stop_settling_when(nullptr);
}

TEST(Settle, RefusesWhatItCannotHoldStill) {
  lab::Lab lab = pond();
  lab.add({.name = "cork", .corner = {0.0, 0.0, 10.0 * dx}});
  EXPECT_THROW((void)settled(lab.scene, lab.initial), InputError);
  lab = pond();
  lab.scene.gravity = {};
  EXPECT_THROW((void)settled(lab.scene, lab.initial), InputError);
}

}  // namespace
}  // namespace tripoint
