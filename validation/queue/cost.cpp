// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/cost.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

/// Seconds a particle and step, seconds a particle and frame, and seconds at least; measured on the shipped cases, one core.
struct Rates {
  double step, frame, least;
};

Rates rates_of(const std::string& engine) {
  if (engine == "tripoint") return {0.7e-6, 1e-6, 0.03};
  if (engine.starts_with("lammps")) return {1e-6, 1e-6, 0.1};
  if (engine == "exact") return {0.0, 2e-6, 0.01};
  return {0.0, 2e-6, 0.1};  // engines of rigid bodies: their steps are nearly free beside the frames
}

/// Whether particles push each other: liquids and what is elastic. Else they stand, conduct heat or move as whole bodies, at a
/// tenth of the cost.
bool has_forces(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.phase != Phase::rigid && b.motion == Motion::free; });
}

/// Fastest sound of the materials that the scene holds [m/s]; 0 where none has one.
double fastest_sound(const Scene& scene) {
  double fastest = 0.0;
  for (const auto& body : scene.bodies)
    for (const auto& m : scene.materials) {
      if (m.name != body.material) continue;
      if (m.stiffness) fastest = std::max(fastest, std::sqrt(*m.stiffness));
      if (m.young_modulus && body.phase != Phase::rigid) fastest = std::max(fastest, std::sqrt(*m.young_modulus / m.density));
    }
  return fastest;
}

double steps_of(const Job& job) {
  if (job.resolution.time_step) return job.scene.end_time / *job.resolution.time_step;
  const double sound = fastest_sound(job.scene), frames = static_cast<double>(job.times.size());
  if (sound <= 0.0) return std::max(1000.0, frames);
  return std::max(frames, job.scene.end_time * sound / (0.2 * job.resolution.support_ratio * job.resolution.spacing));
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
  const double n = static_cast<double>(particles), a_step = has_forces(job.scene) ? rates.step : 0.1 * rates.step;
  return rates.least + n * (a_step * steps_of(job) + rates.frame * static_cast<double>(job.times.size()));
}

}  // namespace tripoint
