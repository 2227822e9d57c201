// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/cost.hpp"

#include <algorithm>
#include <cmath>

#include "files/job.hpp"
#include "scene/effect_rule.hpp"
#include "scene/phase_values.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/results.hpp"

namespace tripoint {
namespace {

/// Seconds a particle and step, seconds a particle and frame, and seconds at least; measured on the shipped
/// cases, one core.
struct Rates {
  double step, frame, least;
};

Rates rates_of(const std::string& engine) {
  if (is_own_solver(engine)) return {0.7e-6, 1e-6, 0.03};
  if (is_lammps(engine)) return {1e-6, 1e-6, 0.1};
  if (is_exact(engine)) return {0.0, 2e-6, 0.01};
  return {0.0, 2e-6, 0.1};  // engines of rigid bodies: their steps are nearly free beside the frames
}

/// Whether particles push each other: liquids and elastic bodies. Else they stand, conduct heat or move as
/// whole bodies, at a tenth of the cost.
bool has_forces(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.phase != Phase::rigid && b.motion == Motion::free; });
}

/// Fastest sound of matter that flows or bends [m/s]; 0 where there is none. Rigid matter has none, whatever
/// its material says.
double fastest_sound(const Scene& scene) {
  const bool flows = calls_for(scene, "pressure"), bends = calls_for(scene, "elastic");
  double fastest = 0.0;
  for (const auto& body : scene.bodies) {
    const Material& m = scene.material(body.material);
    const bool is_elastic = body.phase == Phase::elastic || m.solid == SolidKind::elastic;
    if (flows && m.stiffness) fastest = std::max(fastest, std::sqrt(*m.stiffness));
    if (bends && is_elastic && m.young_modulus)
      fastest = std::max(fastest, std::sqrt(*m.young_modulus / m.density));
  }
  return fastest;
}

/// Greatest diffusivity of matter that grows warmer or colder [m2/s]; 0 where there is none. Matter held at a
/// temperature bounds no step.
double greatest_diffusivity(const Scene& scene) {
  double greatest = 0.0;
  if (!calls_for(scene, "heat")) return greatest;
  for (const auto& body : scene.bodies) {
    const Material& m = scene.material(body.material);
    if (body.temperature_held || !m.conductivity || !m.heat_capacity) continue;
    for (const Phase phase : {Phase::liquid, Phase::rigid})
      greatest = std::max(greatest, conductivity_of(m, phase) / (m.density * heat_capacity_of(m, phase)));
  }
  return greatest;
}

double steps_of(const Job& job) {
  if (job.resolution.time_step) return job.scene.end_time / *job.resolution.time_step;
  const double sound = fastest_sound(job.scene), diffusivity = greatest_diffusivity(job.scene);
  const double frames = static_cast<double>(job.times.size()), dx = job.resolution.spacing;
  if (sound <= 0.0 && diffusivity <= 0.0) return std::max(1000.0, frames);
  const double waves = job.scene.end_time * sound / (0.2 * job.resolution.support_ratio * dx);
  const double conduction = 5.0 * job.scene.end_time * diffusivity / (dx * dx);
  return std::max({frames, waves, conduction});
}

}  // namespace

std::map<std::string, double> measured_costs(const Results& results) {
  std::map<std::string, double> costs;
  for (const auto& c : results.cases)
    for (const auto& e : c.engines)
      for (const auto& run : e.runs)
        if (!run.folder.empty() && run.cost.cpu_s > 0.0) costs[run.folder] = run.cost.cpu_s;
  return costs;
}

double predicted_cost(const Job& job, const std::string& engine, std::size_t particles) {
  const auto rates = rates_of(engine);
  const double n = static_cast<double>(particles),
               a_step = has_forces(job.scene) ? rates.step : 0.1 * rates.step;
  return rates.least + n * (a_step * steps_of(job) + rates.frame * static_cast<double>(job.times.size()));
}

}  // namespace tripoint
