// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "effects/lab.hpp"

/// Small scenes of what melts and freezes.
namespace tripoint::lab {

/// Far on either side of t_melt = t_solid = 350 K; without latent heat it melts at once [K].
inline constexpr double hot = 400.0, cold = 300.0;
/// One temperature everywhere [K].
inline const auto constant = [](double T) { return [T](const Vec3&) { return T; }; };

struct Meltable {
  double t_melt = 350.0, t_solid = 350.0, latent_heat = 0.0;  ///< [K], [K], [J/kg]
  SolidKind solid = SolidKind::rigid;
  double conductivity = 1e-12;  ///< as good as none: every particle for itself [W/m/K]
};

/// A lab whose material 0 melts; no stiffness and no gravity: what is liquid flies on.
inline Lab melting_lab(double spacing, const Meltable& m = {}) {
  Lab lab(spacing);
  Material& material = lab.scene.materials[0];
  material.conductivity = m.conductivity;
  material.t_melt = m.t_melt;
  material.t_solid = m.t_solid;
  material.latent_heat = m.latent_heat;
  material.solid = m.solid;
  if (m.solid == SolidKind::elastic) {
    material.young_modulus = 1e5;
    material.poisson_ratio = 0.3;
  }
  return lab;
}

inline std::vector<int> integers_by_id(const Simulation& s, const Field<int>& f) {
  const Particles& p = s.state().particles;
  std::vector<int> values(p.size());
  for (std::size_t id = 0; id < p.size(); ++id) values[id] = p[f][p.row(id)];
  return values;
}
inline std::vector<Vec3> places(const Simulation& s) {
  std::vector<Vec3> values;
  for (std::size_t id = 0; id < s.state().particles.size(); ++id)
    values.push_back(s.state().unwrapped(s.state().particles.row(id)));
  return values;
}
inline std::vector<Vec3> speeds(const Simulation& s) {
  std::vector<Vec3> values;
  for (std::size_t id = 0; id < s.state().particles.size(); ++id)
    values.push_back(s.state().particles.velocity(s.state().particles.row(id)));
  return values;
}
inline std::size_t living_bodies(const Simulation& s) {
  const auto alive = s.state().bodies[field::body_alive];
  return static_cast<std::size_t>(std::count(alive.begin(), alive.end(), 1));
}
/// Sum of all entries [J].
inline double total_energy(const Ledger& ledger) {
  double sum = 0.0;
  for (const auto& [name, joules] : ledger.energy) sum += joules;
  return sum;
}
/// A scene with its particles in another order, and with that the ids. @return new id of each old one
inline std::vector<std::size_t> shuffle(Lab& lab, unsigned seed) {
  std::vector<std::size_t> old(lab.initial.size());
  for (std::size_t n = 0; n < old.size(); ++n) old[n] = n;
  std::shuffle(old.begin(), old.end(), std::mt19937(seed));
  const InitialState from = lab.initial;
  std::vector<std::size_t> now(old.size());
  for (std::size_t n = 0; n < old.size(); ++n) {
    now[old[n]] = n;
    lab.initial.position[n] = from.position[old[n]];
    lab.initial.velocity[n] = from.velocity[old[n]];
    lab.initial.mass[n] = from.mass[old[n]];
    lab.initial.temperature[n] = from.temperature[old[n]];
    lab.initial.phase[n] = from.phase[old[n]];
    lab.initial.body[n] = from.body[old[n]];
    lab.initial.material[n] = from.material[old[n]];
    lab.initial.source[n] = from.source[old[n]];
  }
  return now;
}

}  // namespace tripoint::lab
