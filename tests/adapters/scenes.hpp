// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>

#include "files/job.hpp"
#include "sampling/sample.hpp"

/// Jobs as the harness makes them: the scene's own sampler, mass properties from the particles.
namespace tripoint::test {

struct Prepared {
  Job job;
  InitialState initial;
};

inline Shape box(const Vec3& min, const Vec3& max) {
  Shape s;
  s.min = min;
  s.max = max;
  return s;
}

inline Shape sphere(const Vec3& centre, double radius) {
  Shape s;
  s.kind = Shape::Kind::sphere;
  s.centre = centre;
  s.radius = radius;
  return s;
}

inline Material material(double density) {
  Material m;
  m.name = "solid";
  m.density = density;
  return m;
}

struct Spin {
  Vec3 velocity, angular_velocity;  ///< [m/s], [rad/s]
};

inline Body rigid(const std::string& name, const Shape& shape, const Spin& spin = {},
                  Motion motion = Motion::free) {
  Body b;
  b.name = name;
  b.material = "solid";
  b.phase = Phase::rigid;
  b.motion = motion;
  b.shape = shape;
  b.velocity.value = spin.velocity;
  b.angular_velocity = spin.angular_velocity;
  return b;
}

/// Samples the scene and fills the job; `frames` equal output intervals to the end.
inline Prepared prepare(Scene scene, double end, int frames) {
  Prepared p;
  scene.end_time = end;
  p.initial = sample(scene);
  const auto rows = body_rows(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::vector<Vec3> at;
    std::vector<double> mass;
    for (std::size_t i = 0; i < p.initial.size(); ++i)
      if (p.initial.source[i] == static_cast<int>(b)) {
        at.push_back(p.initial.position[i]);
        mass.push_back(p.initial.mass[i]);
      }
    JobBody body;
    const Body& given = scene.bodies[b];
    body.name = given.name;
    body.material = given.material;
    body.index = rows[b];
    body.phase = given.phase;
    body.motion = given.motion;
    body.keyframes = given.keyframes;
    body.velocity = given.velocity.value;
    body.angular_velocity = given.angular_velocity;
    body.temperature_held = given.temperature_held;
    body.properties = mass_properties(at, mass);
    p.job.bodies.push_back(body);
  }
  p.job.case_id = "test";
  p.job.resolution.spacing = scene.spacing;
  p.job.resolution.support_ratio = scene.support_ratio;
  for (int n = 0; n <= frames; ++n) p.job.times.push_back(end * n / frames);
  p.job.scene = std::move(scene);
  p.job.output = ".";
  p.job.particles = "particles.h5";
  return p;
}

/// The asymmetric block of 4 x 6 x 10 particles, 1 kg.
inline Prepared block(const Spin& spin, const Vec3& gravity, double end, int frames, double time_step) {
  Scene s;
  s.spacing = 0.1;
  s.gravity = gravity;
  s.materials = {material(1.0 / 0.24)};
  s.bodies = {rigid("block", box({-0.2, -0.3, -0.5}, {0.2, 0.3, 0.5}), spin)};
  Prepared p = prepare(s, end, frames);
  p.job.resolution.time_step = time_step;
  return p;
}

/// A bar of D = 1e-6 m2/s along x, at rest, of `count` x 6 x 6 cells.
inline Prepared bar(int count, double length, const TemperatureField& temperature, bool periodic, double end,
                    int frames) {
  Scene s;
  s.spacing = length / count;
  Material m = material(1000.0);
  m.conductivity = 1.0;
  m.heat_capacity = 1000.0;
  s.materials = {m};
  const Vec3 corner{length, 6 * s.spacing, 6 * s.spacing};
  s.bodies = {rigid("bar", box({}, corner), {}, Motion::fixed)};
  s.bodies[0].temperature = temperature;
  s.periodic = {periodic, true, true};
  s.min = Vec3{};
  s.max = corner;
  return prepare(s, end, frames);
}

}  // namespace tripoint::test
