// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/rheo_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "adapters/lammps/heat_scene.hpp"
#include "adapters/lammps/rheo.hpp"
#include "scene/phase_values.hpp"

namespace tripoint::lammps {
namespace {

constexpr double least_viscosity = 1e-12;  // pair rheo divides by the sum of two

const Material& material_of(const Job& job, std::size_t body) {
  return job.scene.material(job.bodies[body].material);
}

/// Young's modulus of a body's bonds when it is solid [Pa]; none for matter that is never free and solid.
std::optional<double> modulus_of(const Job& job, std::size_t body) {
  const JobBody& b = job.bodies[body];
  const Material& m = material_of(job, body);
  if (b.motion != Motion::free || (b.phase == Phase::liquid && !m.t_melt)) return {};
  const bool rigid = b.phase == Phase::rigid || (b.phase == Phase::liquid && m.solid == SolidKind::rigid) ||
                     (m.t_melt && m.solid == SolidKind::rigid);
  return rigid ? choice_for(job).rigid_modulus : m.young_modulus;
}

double modulus(const Job& job) {
  double E = 0.0;
  for (std::size_t b = 0; b < job.bodies.size(); ++b) E = std::max(E, modulus_of(job, b).value_or(0.0));
  return E;
}

/// Density of the free matter; walls have the same, because they use it for nothing else.
double density_of(const Job& job) {
  for (std::size_t b = 0; b < job.bodies.size(); ++b)
    if (job.bodies[b].motion == Motion::free) return material_of(job, b).density;
  return material_of(job, 0).density;
}

/// Greatest diffusivity of heat among bodies whose temperature is not held [m2/s].
double fastest_diffusion(const Job& job) {
  double D = 0.0;
  for (std::size_t b = 0; b < job.bodies.size(); ++b)
    if (!job.bodies[b].temperature_held) D = std::max(D, diffusivity(job.scene, job.scene.bodies[b]));
  return D;
}

/// Speed of sound of the liquid, else of the bonds [m/s]. Where everything is held there is no sound, and
/// heat sets the time.
double speed_of_sound(const Job& job) {
  if (const auto given = choice_for(job).sound_speed) return *given;
  double k = 0.0;
  for (const Material& m : job.scene.materials) k = std::max(k, m.stiffness.value_or(0.0));
  if (k == 0.0) k = modulus(job) / density_of(job);
  return k > 0.0 ? std::sqrt(k) : anything_free(job) ? 0.0 : fastest_diffusion(job) / job.resolution.spacing;
}

/// Walls hold the liquid like themselves: the harmonic mean with the wall's is then its own [Pa s].
double viscosity_of(const Job& job, std::size_t body) {
  double mu = material_of(job, body).viscosity;
  if (job.bodies[body].motion != Motion::free)
    for (const Material& m : job.scene.materials) mu = std::max(mu, m.viscosity);
  return mu;
}

std::string why_not_event(const Event& e) {
  if (e.kind != Event::Kind::heat)
    return "of the events RHEO is handed heating only: no merge, split, release, hold or grip";
  if (e.region && e.region->kind != Shape::Kind::box && e.region->kind != Shape::Kind::sphere)
    return "RHEO heats boxes and spheres here, and the region of an event is neither";
  return {};
}

std::string why_not_matter(const Job& job, std::size_t body) {
  const JobBody& b = job.bodies[body];
  const Material& m = material_of(job, body);
  if (!job.scene.bodies[body].temperature) return fmt::format("{} has no temperature", b.name);
  if (!m.conductivity || !m.heat_capacity)
    return fmt::format("{} has no conductivity or no heat capacity", m.name);
  if (has_two_phases(m))
    return fmt::format(
        "{} conducts or holds heat otherwise when solid (solid_conductivity, solid_heat_capacity); RHEO is "
        "handed one value for "
        "both phases",
        m.name);
  if (std::abs(heat_per_volume(job.scene, job.scene.bodies[body]) /
                   heat_per_volume(job.scene, job.scene.bodies.front()) -
               1.0) > 1e-9)
    return fmt::format(
        "RHEO conserves heat between equal heat capacities only, and that of {} differs from that of {}",
        b.name, job.bodies.front().name);
  if (is_turned(b))
    return fmt::format("{} is turned; RHEO is handed driven bodies that are shifted only", b.name);
  if (b.motion != Motion::free) return {};
  if (m.density != density_of(job))
    return fmt::format("{} has another density; RHEO is run here with one", b.name);
  if (m.t_melt && m.t_solid && *m.t_solid < *m.t_melt && choice_for(job).freezing.empty())
    return fmt::format(
        "{} freezes below its melting point; RHEO knows one temperature for both, which the setting freezing "
        "picks",
        m.name);
  if (m.elastic_limit || m.fracture_stretch)
    return fmt::format("{} yields or breaks; bonds of RHEO are run here without either", m.name);
  if ((b.phase != Phase::liquid || m.t_melt) && !modulus_of(job, body))
    return fmt::format(
        "{} is rigid when solid, and RHEO has bonds only; the setting rigid_modulus gives them a modulus",
        m.name);
  return {};
}

std::string why_not_one_network(const Job& job) {
  std::set<double> moduli;
  for (std::size_t b = 0; b < job.bodies.size(); ++b)
    if (const auto E = modulus_of(job, b)) moduli.insert(*E);
  return moduli.size() > 1
             ? "fix rheo/thermal makes bonds of one kind, and the scene's solids differ in Young's modulus"
             : "";
}

}  // namespace

bool anything_free(const Job& job) {
  return std::any_of(job.bodies.begin(), job.bodies.end(),
                     [](const JobBody& b) { return b.motion == Motion::free; });
}

Units rheo_units(const Job& job) {
  const double dx = job.resolution.spacing;
  return {dx, dx / speed_of_sound(job), density_of(job) * dx * dx * dx, {}};
}

RheoMatter rheo_matter(const Job& job, std::size_t body) {
  const Units u = rheo_units(job);
  const Material& m = material_of(job, body);
  RheoMatter r;
  r.viscosity = std::max(viscosity_of(job, body) / (u.pressure() * u.time), least_viscosity);
  r.conductivity = diffusivity(job.scene, job.scene.bodies[body]) * u.time / (u.length * u.length);
  r.melts = m.t_melt && (job.bodies[body].motion == Motion::free || !anything_free(job));
  r.melting = (choice_for(job).freezing == "t_solid" ? m.t_solid : m.t_melt).value_or(0.0);
  r.latent = m.latent_heat.value_or(0.0) / *m.heat_capacity;
  return r;
}

double bond_modulus(const Job& job) { return modulus(job) / rheo_units(job).pressure(); }

double rheo_energy(const RheoMatter& m, double temperature) {
  return temperature + (m.melts && temperature > m.melting ? m.latent : 0.0);
}

bool takes(const Event& e, const std::string& body, const Vec3& r) {
  if (!e.bodies.empty() && std::find(e.bodies.begin(), e.bodies.end(), body) == e.bodies.end()) return false;
  if (!e.region) return true;
  if (e.region->kind == Shape::Kind::sphere) return norm(r - e.region->centre) <= e.region->radius;
  const Vec3 &lo = e.region->min, &hi = e.region->max;
  return lo.x <= r.x && r.x <= hi.x && lo.y <= r.y && r.y <= hi.y && lo.z <= r.z && r.z <= hi.z;
}

std::string why_no_rheo(const Job& job) {
  if (!job.scene.inflows.empty()) return "no inflow into RHEO";
  for (const Event& e : job.scene.events)
    if (const std::string reason = why_not_event(e); !reason.empty()) return reason;
  for (std::size_t b = 0; b < job.bodies.size(); ++b)
    if (const std::string reason = why_not_matter(job, b); !reason.empty()) return reason;
  if (speed_of_sound(job) <= 0.0)
    return "the scene gives no stiffness and no Young's modulus that a time step could follow from";
  return why_not_one_network(job);
}

}  // namespace tripoint::lammps
