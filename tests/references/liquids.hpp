// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "references/scenes.hpp"

/// Scenes with liquid for the tests of references and metrics, made by hand.
namespace tripoint::test {

/// A body of its own material; a liquid has no row among the solid bodies.
inline void add_matter(Prepared& s, const std::string& name, Phase phase, const Lattice& l, const Spin& spin,
                       double density, double viscosity = 0.0, Motion motion = Motion::free) {
  const auto first = s.initial.size();
  Lattice weighed = l;
  weighed.mass = density * std::pow(l.spacing, 3) * l.count[0] * l.count[1] * l.count[2];
  add_body(s, name, weighed, spin, motion);
  const auto row = static_cast<int>(s.job.scene.materials.size());
  Material m;
  m.name = name;
  m.density = density;
  m.viscosity = viscosity;
  m.stiffness = 100.0;
  s.job.scene.materials.push_back(m);
  int solids = 0;
  for (const auto& b : s.job.bodies) solids += b.phase == Phase::liquid ? 0 : 1;
  const int index = phase == Phase::liquid ? -1 : solids - 1;
  auto& body = s.job.bodies.back();
  body.material = s.job.scene.bodies.back().material = name;
  body.phase = s.job.scene.bodies.back().phase = phase;
  body.index = index;
  for (std::size_t i = first; i < s.initial.size(); ++i) {
    s.initial.phase[i] = static_cast<int>(phase);
    s.initial.body[i] = index;
    s.initial.material[i] = row;
  }
}

inline void close_box(Prepared& s, const Vec3& min, const Vec3& max, const std::array<bool, 3>& periodic) {
  s.job.scene.min = min;
  s.job.scene.max = max;
  s.job.scene.periodic = periodic;
}

/// Liquid of nu = 0.01 m2/s between plates 1 m apart across z.
inline Prepared channel(const Vec3& gravity, const Vec3& upper_speed) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = gravity;
  add_matter(s, "liquid", Phase::liquid, {{4, 4, 10}, 0.1, {}, 1.0}, {}, 1000.0, 10.0);
  add_matter(s, "lower", Phase::rigid, {{4, 4, 3}, 0.1, {0, 0, -0.3}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
  add_matter(s, "upper", Phase::rigid, {{4, 4, 3}, 0.1, {0, 0, 1.0}, 1.0}, {upper_speed, {}}, 1000.0, 0.0,
             norm(upper_speed) > 0.0 ? Motion::prescribed : Motion::fixed);
  close_box(s, {0, 0, -1}, {0.4, 0.4, 2}, {true, true, false});
  set_times(s, 20.0, 20);
  return s;
}

/// Two layers of liquid, 0.4 m each, the lower one `ratio` times as heavy.
inline Prepared layers(double ratio) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  add_matter(s, "heavy", Phase::liquid, {{4, 4, 4}, 0.1, {}, 1.0}, {}, 200.0 * ratio);
  add_matter(s, "light", Phase::liquid, {{4, 4, 4}, 0.1, {0, 0, 0.4}, 1.0}, {}, 200.0);
  set_times(s, 1.0, 4);
  return s;
}

/// A block of 0.4 m, of a share of the water's density, in a pool of 1 m2.
inline Prepared pool(double density) {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -9.81};
  add_matter(s, "water", Phase::liquid, {{10, 10, 5}, 0.1, {}, 1.0}, {}, 1000.0);
  add_matter(s, "block", Phase::rigid, {{4, 4, 4}, 0.1, {0.3, 0.3, 0.5}, 1.0}, {}, density);
  close_box(s, {0, 0, -1}, {1, 1, 3}, {true, true, false});
  set_times(s, 1.0, 4);
  return s;
}

/// Two cubes of unequal mass, 0.4 m apart, at 1 and -0.5 m/s along x.
inline Prepared cubes() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  add_matter(s, "left", Phase::rigid, {{4, 4, 4}, 0.1, {-0.6, 0, 0}, 1.0}, {{1, 0, 0}, {}}, 1000.0);
  add_matter(s, "right", Phase::rigid, {{4, 4, 4}, 0.1, {0.2, 0, 0}, 1.0}, {{-0.5, 0, 0}, {}}, 3000.0);
  set_times(s, 0.5, 50);
  return s;
}

/// A periodic box of liquid, 1 m long, that starts with a velocity field.
inline Prepared swinging(const VelocityField& start, int n, double viscosity = 0.0) {
  Prepared s;
  const double dx = 1.0 / n;
  s.job.scene.spacing = dx;
  add_matter(s, "liquid", Phase::liquid, {{n, n, 4}, dx, {}, 1.0}, {}, 1000.0, viscosity);
  s.job.scene.bodies[0].velocity = start;
  close_box(s, {}, {1, 1, 4 * dx}, {true, true, true});
  set_times(s, 0.2, 40);
  return s;
}

inline VelocityField sound_start() {
  VelocityField v;
  v.kind = VelocityField::Kind::cosine;
  v.amplitude = {0.01, 0, 0};
  v.wave_vector = {2 * pi, 0, 0};
  v.phase = 0.7;
  return v;
}

}  // namespace tripoint::test
