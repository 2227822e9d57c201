// SPDX-License-Identifier: BSD-3-Clause
// Light beside heavy. What a contact swings with follows from the lighter body, and so does the speed of
// sound that sets the step: mass ratio brings no limit of its own.
#include "scene/shared_terms.hpp"
#include "step/stability_lab.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace tripoint::stability {
namespace {

using lab::Lab;

Lab quiet() {
  Lab lab = lab::liquid_lab(1.0, 1.0, 0.0, 1.0);
  // a contact that also pulls is a spring: its frontier is 2/omega
  lab.scene.modes[term::clamp] = Mode::paper;
  return lab;
}

/// Cubes of 2 x 2 x 2 particles that fill a periodic box, face on face, every second one `density` times as
/// dense.
Point cubes(double density) {
  Lab lab = quiet();
  const std::size_t heavy = lab::add_material_like(lab, density, 0.0);
  const double speed = 1e-7 * std::sqrt(density);
  for (int n = 0; n < 8; ++n) {
    const int x = n % 2, y = n / 2 % 2, z = n / 4;
    lab.add({.name = "cube " + std::to_string(n),
             .material = (x + y + z) % 2 ? heavy : 0,
             .corner = {2.0 * x, 2.0 * y, 2.0 * z},
             .count = {2, 2, 2},
             .velocity = speed * Vec3{std::sin(1.0 + n), std::sin(5.0 + 3.0 * n), std::sin(2.0 + 7.0 * n)}});
  }
  lab.make_periodic({true, true, true}, {}, {side, side, side});
  return {"contact",
          "corrected",
          "density ratio",
          density,
          oscillation_limit(lab, true),
          own_step(lab),
          stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, lab.initial)))};
}

/// A cube of 2 x 2 x 2 particles in liquid, `density` times as dense.
Point cube(double density) {
  Lab lab = quiet();
  const std::size_t other = lab::add_material_like(lab, density, 0.0);
  lab.add({.name = "sea", .count = {side, side, side}, .phase = Phase::liquid});
  lab.add({.name = "cube", .material = other, .corner = {1.0, 1.0, 1.0}, .count = {2, 2, 2}});
  InitialState& s = lab.initial;
  for (std::size_t i = side * side * side; i-- > 0;) {  // the liquid leaves room
    const Vec3 r = s.position[i];
    if (std::max({std::abs(r.x - 1.5), std::abs(r.y - 1.5), std::abs(r.z - 1.5)}) > 1.0) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    for (auto* column : {&s.position, &s.velocity}) column->erase(column->begin() + at);
    for (auto* column : {&s.phase, &s.body, &s.material, &s.source}) column->erase(column->begin() + at);
    s.mass.erase(s.mass.begin() + at);
  }
  lab.make_periodic({true, true, true}, {}, {side, side, side});
  const double limit = oscillation_limit(lab, true);
  const double speed = 1e-7 / std::sqrt(std::min(1.0, density));
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s.body[i] < 0)
      s.velocity[i] =
          speed * Vec3{std::sin(7.0 * double(i)), std::sin(11.0 * double(i)), std::sin(13.0 * double(i))};
  return {"afloat",
          "corrected",
          "density ratio",
          density,
          limit,
          own_step(lab),
          stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, s)))};
}

}  // namespace

void add_contact_points(std::vector<Point>& list) {
  for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) list.push_back(cubes(ratio));
  for (const double ratio : {0.001, 0.1, 1.0, 10.0, 1000.0}) list.push_back(cube(ratio));
}

}  // namespace tripoint::stability
