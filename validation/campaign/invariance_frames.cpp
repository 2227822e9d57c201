// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/invariance_frames.hpp"

#include <algorithm>

namespace tripoint {
namespace {

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}
void scale(std::vector<Vec3>& values, double by) {
  for (Vec3& v : values) v *= by;
}
void scale(std::optional<double>& value, double by) {
  if (value) *value *= by;
}

void scale(EffectValues& values, std::string_view key, double by) {
  if (const auto at = values.find(key); at != values.end()) at->second *= by;
}

void measure_in(const Units& u, Material& m) {
  const double pressure = u.mass / (u.length * u.time * u.time), speed = u.length / u.time;
  m.density *= u.mass / (u.length * u.length * u.length);
  m.viscosity *= pressure * u.time;
  scale(m.values, "solid_viscosity", pressure * u.time);
  scale(m.stiffness, speed * speed);
  scale(m.young_modulus, pressure);
  for (auto* k : {&m.conductivity, &m.solid_conductivity})
    scale(*k, u.mass * u.length / (u.time * u.time * u.time));
  for (auto* c : {&m.heat_capacity, &m.solid_heat_capacity, &m.latent_heat}) scale(*c, speed * speed);
}

void measure_in(const Units& u, Body& b) {
  b.angular_velocity *= 1.0 / u.time;
  for (auto& k : b.keyframes) {
    k.time *= u.time;
    k.position *= u.length;
  }
}

}  // namespace

Quaternion SignedAxes::rotation(const Quaternion& q) const {
  const Vec3 axis = axial({q.x, q.y, q.z});
  return {q.w, axis.x, axis.y, axis.z};
}

SignedAxes SignedAxes::inverse() const {
  SignedAxes back{{}, {}, determinant};
  for (std::size_t a = 0; a < 3; ++a) {
    back.from[from[a]] = a;
    back.sign[from[a]] = sign[a];
  }
  return back;
}

void turn(const SignedAxes& to, ChangedScene& changed) {
  Scene& s = changed.scene;
  s.gravity = to.vector(s.gravity);
  const auto periodic = s.periodic;
  for (std::size_t a = 0; a < 3; ++a) s.periodic[a] = periodic[to.from[a]];
  if (s.min && s.max) {
    const Vec3 p = to.vector(*s.min), q = to.vector(*s.max);
    s.min = Vec3{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)};
    s.max = Vec3{std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)};
  }
  for (auto& b : s.bodies) b.angular_velocity = to.axial(b.angular_velocity);
  for (auto& r : changed.initial.position) r = to.vector(r);
  for (auto& v : changed.initial.velocity) v = to.vector(v);
}

void turn(const SignedAxes& to, Snapshot& s) {
  for (auto& r : s.position) r = to.vector(r);
  for (auto& v : s.velocity) v = to.vector(v);
  for (auto& b : s.bodies) {
    for (Vec3* v : {&b.position, &b.velocity, &b.force}) *v = to.vector(*v);
    for (Vec3* v : {&b.angular_velocity, &b.torque}) *v = to.axial(*v);
    b.orientation = to.rotation(b.orientation);
  }
  s.momentum = to.vector(s.momentum);
  s.angular_momentum = to.axial(s.angular_momentum);
}

void measure_in(const Units& u, ChangedScene& changed) {
  Scene& s = changed.scene;
  s.end_time *= u.time;
  s.output_interval *= u.time;
  s.spacing *= u.length;
  scale(s.time_step, u.time);
  s.gravity *= u.length / (u.time * u.time);
  if (s.min) *s.min *= u.length;
  if (s.max) *s.max *= u.length;
  s.contact_viscosity *= u.mass / (u.length * u.time);
  scale(s.values, "heat_constant", u.length * u.length / u.time);
  for (auto& m : s.materials) measure_in(u, m);
  for (auto& b : s.bodies) measure_in(u, b);
  for (auto& e : s.events) {
    e.time *= u.time;
    scale(e.until, u.time);
  }
  auto& p = changed.initial;
  scale(p.position, u.length);
  scale(p.velocity, u.length / u.time);
  scale(p.mass, u.mass);
}

void measure_in(const Units& u, Snapshot& s) {
  const double speed = u.length / u.time, force = u.mass * speed / u.time,
               pressure = force / (u.length * u.length);
  s.time *= u.time;
  scale(s.position, u.length);
  scale(s.velocity, speed);
  scale(s.mass, u.mass);
  scale(s.density, u.mass / (u.length * u.length * u.length));
  scale(s.pressure, pressure);
  for (auto& b : s.bodies) {
    b.position *= u.length;
    b.velocity *= speed;
    b.angular_velocity *= 1.0 / u.time;
    b.mass *= u.mass;
    b.force *= force;
    b.torque *= force * u.length;
  }
  s.total_mass *= u.mass;
  s.momentum *= u.mass * speed;
  s.angular_momentum *= u.mass * speed * u.length;
  for (auto* energies : {&s.energy, &s.heat_given})
    for (auto& [name, energy] : *energies) energy *= u.mass * speed * speed;
}

void ride(const Vec3& U, Snapshot& s) {
  const Vec3 way = s.time * U, P = s.momentum;
  Vec3 lever;  // sum of m r, seen from the observer
  for (std::size_t i = 0; i < s.position.size() && i < s.mass.size(); ++i)
    if (finite(s.position[i])) lever += s.mass[i] * s.position[i];
  for (auto& r : s.position) r += way;
  for (auto& v : s.velocity) v += U;
  for (auto& b : s.bodies) {
    b.position += way;
    b.velocity += U;
  }
  const double M = s.total_mass;
  s.momentum += M * U;
  s.angular_momentum += cross(lever, U) + cross(way, P);
  if (const auto kinetic = s.energy.find("kinetic"); kinetic != s.energy.end())
    kinetic->second += dot(P, U) + 0.5 * M * dot(U, U);
}

}  // namespace tripoint
