// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "effects/lab.hpp"

/// Small scenes of liquids, walls and bodies that touch.
namespace tripoint::lab {

/// Material 0 is the liquid: density, viscosity, stiffness.
inline Lab liquid_lab(double spacing, double density, double viscosity, double stiffness,
                      Mode mode = Mode::corrected) {
  Lab lab(spacing, mode);
  lab.scene.materials[0].density = density;
  lab.scene.materials[0].viscosity = viscosity;
  lab.scene.materials[0].stiffness = stiffness;
  return lab;
}

inline std::size_t add_material_like(Lab& lab, double density, double viscosity) {
  Material m = lab.scene.materials[0];
  m.name = "m" + std::to_string(lab.scene.materials.size());
  m.density = density;
  m.viscosity = viscosity;
  lab.scene.materials.push_back(m);
  return lab.scene.materials.size() - 1;
}

/// A column of `width` x `width` x `depth` particles over the floor z = 0, periodic in x and y; spacing
/// 1/depth.
inline Lab column(int depth, int width, double viscosity, double stiffness, double gravity,
                  Mode mode = Mode::corrected) {
  const double dx = 1.0 / depth;
  Lab lab = liquid_lab(dx, 1000.0, viscosity, stiffness, mode);
  lab.scene.gravity = {0.0, 0.0, -gravity};
  lab.scene.viscosity_form = ViscosityForm::laplacian;
  lab.add({.name = "water",
           .corner = {0.0, 0.0, 0.5 * dx},
           .count = {width, width, depth},
           .phase = Phase::liquid});
  lab.add({.name = "floor",
           .corner = {0.0, 0.0, -2.5 * dx},
           .count = {width, width, 3},
           .phase = Phase::rigid,
           .motion = Motion::fixed});
  lab.make_periodic({true, true, false}, {0.0, 0.0, -5.5 * dx}, {width, width, 3 * depth});
  return lab;
}

/// Moves every particle of liquid by up to `amplitude` spacings.
inline void jitter(Lab& lab, double amplitude) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-amplitude * lab.scene.spacing,
                                                 amplitude * lab.scene.spacing);
  for (std::size_t i = 0; i < lab.initial.position.size(); ++i)
    if (lab.initial.body[i] < 0)
      lab.initial.position[i] += {uniform(random), uniform(random), uniform(random)};
}

/// Each particle's velocity from its place.
template <class Velocity>
void set_velocity(Lab& lab, Velocity velocity) {
  for (std::size_t i = 0; i < lab.initial.position.size(); ++i)
    if (lab.initial.body[i] < 0) lab.initial.velocity[i] = velocity(lab.initial.position[i]);
}

inline std::vector<Vec3> positions_by_id(const Simulation& s) {
  const Particles& p = s.state().particles;
  std::vector<Vec3> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = s.state().unwrapped(p.row(id));
  return values;
}
inline std::vector<Vec3> vectors_by_id(const Simulation& s, const VectorField<double>& f) {
  const Particles& p = s.state().particles;
  std::vector<Vec3> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = p.vector(p.row(id), f);
  return values;
}
inline std::vector<Vec3> velocities_by_id(const Simulation& s) { return vectors_by_id(s, field::velocity); }

}  // namespace tripoint::lab
