// SPDX-License-Identifier: BSD-3-Clause
// Contact has no limit of the step of its own. What it has is an accuracy: of a head-on hit of two equal
// cubes, whose exact end is that they have changed velocities, over the step and the speed.
// validation/stability/contact.csv is what was accepted; TRIPOINT_CONTACT_MAP=PATH writes it anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "effects/fluid_lab.hpp"
#include "scene/guard_name.hpp"

namespace tripoint {
namespace {

// Between the outer layers at the start [spacings]; they press on each other from 1 on
constexpr double gap = 1.5;

struct Hit {
  double speed;          ///< of approach, over that of sound
  double step;           ///< over the step that the solver takes by itself
  double energy = 0.0;   ///< |kinetic energy at the end/at the start - 1|
  double overlap = 0.0;  ///< most that the outer layers come nearer than one spacing [spacings]
};

std::string name_of(const Hit& h) { return fmt::format("{:g},{:g}", h.speed, h.step); }

/// Cubes of 4 x 4 x 4, spacing 1, sound 1: one flies at the other, and the run ends when they are apart
/// again.
Hit hit(double speed, double share) {
  lab::Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  lab.add({.name = "left", .count = {4, 4, 4}, .velocity = {speed, 0.0, 0.0}});
  lab.add({.name = "right", .corner = {3.0 + gap, 0.0, 0.0}, .count = {4, 4, 4}});
  lab.scene.unguarded = {GuardName::overlap, GuardName::time_step, GuardName::ledger};
  lab.scene.time_step = share * Simulation(lab.scene, lab.initial).bound().dt;
  Simulation s(lab.scene, lab.initial, {.force_time_step = true});
  const auto x = [&](std::size_t body) { return s.state().bodies[field::body_centre][body].x; };
  const auto v = [&](std::size_t body) { return s.state().bodies[field::body_velocity][body]; };
  Hit h{speed, share};
  const double first = x(1) - x(0) - gap;
  // Apart again, or right through
  for (double distance = gap; distance > -8.0 && (distance < 1.2 || v(1).x <= v(0).x);) {
    s.advance_to(s.state().time + *lab.scene.time_step);
    distance = x(1) - x(0) - first;
    h.overlap = std::max(h.overlap, 1.0 - distance);
  }
  h.energy = std::abs((dot(v(0), v(0)) + dot(v(1), v(1))) / (speed * speed) - 1.0);
  return h;
}

std::map<std::string, Hit> stored_map() {
  std::ifstream in(CONTACT_MAP);
  std::map<std::string, Hit> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("speed")) continue;
    std::ranges::replace(line, ',', ' ');
    std::stringstream cells(line);
    Hit h{};
    if (cells >> h.speed >> h.step >> h.energy >> h.overlap) rows[name_of(h)] = h;
  }
  return rows;
}

TEST(ContactMap, AHitErrsNoMoreThanItDidOverStepsAndSpeeds) {
  const auto stored = stored_map();
  const char* path = std::getenv("TRIPOINT_CONTACT_MAP");
  std::string text = "speed [of sound],step [of the solver's own],energy error [1],overlap [spacings]\n";
  std::size_t count = 0;
  for (const double speed : {0.01, 0.03, 0.1, 0.3, 0.5}) {
    for (const double step : {0.25, 0.5, 1.0, 2.0}) {
      const Hit h = hit(speed, step);
      text += fmt::format("{},{:.4g},{:.4g}\n", name_of(h), h.energy, h.overlap);
      ++count;
      if (path) continue;
      ASSERT_TRUE(stored.contains(name_of(h))) << name_of(h);
      EXPECT_LE(h.energy, 1.05 * stored.at(name_of(h)).energy + 1e-10)
          << name_of(h);  // stored to four digits, summed over many steps
      EXPECT_LE(h.overlap, 1.02 * stored.at(name_of(h)).overlap) << name_of(h);
    }
  }
  if (path)
    std::ofstream(path) << text;
  else
    EXPECT_EQ(stored.size(), count);
}

/// What a contact is made for: a tenth of the speed of sound, at the solver's own step.
TEST(ContactMap, AtATenthOfSoundAndTheSolversOwnStepEnergyComesBackToOneInAHundred) {
  const Hit whole = hit(0.1, 1.0), half = hit(0.1, 0.5);
  EXPECT_LT(whole.energy, 0.01);
  EXPECT_LT(half.energy, whole.energy);
  EXPECT_LT(whole.overlap, 1.0) << "overlap beyond one spacing is no contact any more";
}

}  // namespace
}  // namespace tripoint
