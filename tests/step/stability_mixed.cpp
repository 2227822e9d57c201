// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <random>

#include "effects/phase_lab.hpp"
#include "scene/shared_terms.hpp"
#include "step/stability_lab.hpp"

namespace tripoint::stability {
namespace {

using lab::Lab;

/// Two blocks beside each other in a periodic box, the upper one of material 1.
void add_two(Lab& lab, const lab::Block& like) {
  lab::Block block = like;
  block.name = "low";
  block.count = {side, side, side};
  lab.add(block);
  block.name = "high";
  block.material = 1;
  block.corner = {0.0, 0.0, double(side)};
  lab.add(block);
  lab.make_periodic({true, true, true}, {}, {side, side, 2 * side});
}

/// Conductivities 1 : ratio, jittered; what is warm diffuses at rest.
Point heat(Mode mode, const char* parameter, double ratio, double jitter) {
  Lab lab(1.0, mode);
  lab.scene.materials[0].density = lab.scene.materials[0].heat_capacity.emplace(1.0);
  lab.add_material(1.0, ratio, 1.0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  add_two(lab,
          {.motion = Motion::fixed, .temperature = [&](const Vec3&) { return 1000.0 + uniform(random); }});
  lab::jitter_all(lab, jitter);
  const auto spread = [](const Simulation& s) {
    const auto T = s.state().particles[field::temperature];
    return *std::ranges::max_element(T) - *std::ranges::min_element(T);
  };
  return {"heat",        std::string(to_string(mode)), parameter, ratio, conduction_limit(lab),
          own_step(lab), stays(lab, spread, 3.0)};
}

/// Viscosities 1 : ratio, jittered, with next to no pressure.
Point mixed_viscosity(ViscosityForm form, double ratio) {
  Lab lab = lab::liquid_lab(1.0, 1.0, 1.0, 1e-16);
  lab.scene.modes[term::clamp] = Mode::paper;
  lab.scene.viscosity_form = form;
  const bool central = form == ViscosityForm::central;
  lab::add_material_like(lab, 1.0, ratio);
  add_two(lab, {.phase = Phase::liquid});
  lab::jitter_all(lab, 0.1);
  // Lambda dt < 1, as velocities are predicted to the full step
  const double limit = 0.5 * friction_limit(lab);
  disturb(lab, 1e-5);
  return {central ? "viscosity central" : "viscosity laplacian",
          "corrected",
          "viscosity ratio",
          ratio,
          limit,
          own_step(lab),
          stays(lab, kinetic, kinetic(Simulation(lab.scene, lab.initial)))};
}

Point elastic(const char* parameter, double value, Lab lab) {
  const double limit = elastic_limit(lab, lab::Deformable(lab));
  disturb(lab, 1e-8);
  return {"elastic",
          "corrected",
          parameter,
          value,
          limit,
          own_step(lab),
          stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, lab.initial)))};
}

Point hourglass(double stiffness) {
  Lab lab = lab::elastic_lab(1.0);
  lab.scene.values["hourglass"] = stiffness;
  lab.add({.count = {side, side, side}, .phase = Phase::elastic});
  return elastic("hourglass stiffness", stiffness, lab);
}

/// Two elastic blocks of one object, the upper one `ratio` times as stiff.
Point joined(double ratio) {
  Lab lab = lab::elastic_lab(1.0);
  Material stiff = lab.scene.materials[0];
  stiff.name = "stiff";
  stiff.young_modulus = ratio;
  lab.scene.materials.push_back(stiff);
  lab.add({.name = "soft", .count = {side, side, side}, .phase = Phase::elastic});
  lab.add({.name = "stiff",
           .material = 1,
           .corner = {0.0, 0.0, double(side)},
           .count = {side, side, side},
           .phase = Phase::elastic});
  lab.scene.bodies[1].joined_to = {"soft"};
  return elastic("stiffness ratio in one object", ratio, lab);
}

/// A jittered liquid that is cooled and freezes at once: bonds are what they were found as, and the bound is
/// local.
Point frozen(double jitter) {
  Lab lab = lab::melting_lab(1.0, {.t_solid = 340.0, .solid = SolidKind::elastic});
  Material& m = lab.scene.materials[0];
  m.density = 1.0;
  m.young_modulus = 1.0;
  m.stiffness = 1e-16;
  m.viscosity = 0.0;
  m.heat_capacity = 1.0;
  lab.add({.count = {side, side, side}, .phase = Phase::liquid, .temperature = [](const Vec3&) {
             return 345.0;
           }});
  lab::jitter_all(lab, jitter);
  Event cool;
  cool.kind = Event::Kind::heat;
  cool.bodies = {"block"};
  cool.time = 0.0;
  cool.until = 1e-4;
  cool.temperature = 300.0;
  lab.scene.events.push_back(cool);
  Simulation cold(lab.scene, lab.initial);
  cold.advance_to(2e-4);
  const double limit = elastic_limit(lab, lab::Deformable(lab, cold)), own = cold.bound().dt;
  disturb(lab, 1e-8);
  return {"elastic",
          "corrected",
          "jitter of frozen matter",
          jitter,
          limit,
          own,
          stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, lab.initial)))};
}

}  // namespace

void add_mixed_points(std::vector<Point>& list) {
  for (const double ratio : {1.0, 10.0, 1000.0})
    list.push_back(heat(Mode::corrected, "conductivity ratio", ratio, 0.2));
  for (const double ratio : {1.0, 10.0, 1000.0})
    list.push_back(heat(Mode::paper, "conductivity ratio", ratio, 0.0));
  for (const double ratio : {1.0, 100.0}) list.push_back(mixed_viscosity(ViscosityForm::laplacian, ratio));
  for (const double ratio : {1.0, 100.0}) list.push_back(mixed_viscosity(ViscosityForm::central, ratio));
  for (const double a : {0.0, 1.0, 4.0}) list.push_back(hourglass(a));
  for (const double ratio : {100.0, 1e4}) list.push_back(joined(ratio));
  for (const double jitter : {0.0, 0.1, 0.2}) list.push_back(frozen(jitter));
}

}  // namespace tripoint::stability
