// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/liquid_scene.hpp"

#include <algorithm>
#include <cmath>

#include "files/job.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {

const Material& material_of_body(const Job& job, std::size_t body) {
  return job.scene.material(job.bodies.at(body).material);
}

std::vector<std::size_t> liquid_bodies(const Job& job) {
  std::vector<std::size_t> list;
  for (std::size_t b = 0; b < job.bodies.size(); ++b)
    if (job.bodies[b].phase == Phase::liquid) list.push_back(b);
  return list;
}

std::size_t only_liquid(const Job& job, const char* function) {
  const auto list = liquid_bodies(job);
  if (list.size() != 1)
    throw InputError(std::string(function) + " holds for one liquid, and the scene has " +
                     std::to_string(list.size()));
  return list.front();
}

double kinematic_viscosity(const Job& job, std::size_t body) {
  const auto& m = material_of_body(job, body);
  if (!(m.viscosity > 0.0))
    throw InputError("material `" + m.name + "` needs a viscosity for an exact viscous flow");
  return m.viscosity / m.density;
}

double state_sound_speed(const Job& job, std::size_t body) {
  double k = 0.0, reference = 0.0;
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    k = std::max(k, material_of_body(job, b).stiffness.value_or(0.0));
    if (job.bodies[b].phase == Phase::liquid)
      reference = std::max(reference, material_of_body(job, b).density);
  }
  if (!(k > 0.0)) throw InputError("no material of the scene has a stiffness or a speed of sound");
  return std::sqrt(job.scene.mode_of(term::state) == Mode::paper
                       ? k
                       : k * reference / material_of_body(job, body).density);
}

std::size_t solid_body(const ReferenceInput& in, Motion motion, const char* function) {
  const auto name = in.args.word("body");
  std::vector<std::size_t> found;
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    const auto& body = in.job.bodies[b];
    if (body.phase != Phase::liquid && body.motion == motion && (!name || body.name == *name))
      found.push_back(b);
  }
  if (found.size() == 1) return found.front();
  throw InputError(std::string(function) + " needs one " + std::string(to_string(motion)) + " body" +
                   (name ? " `" + *name + "`" : "") + ", and the scene has " + std::to_string(found.size()));
}

LiquidReference::LiquidReference(const Job& job, const InitialState& initial) : initial_(initial) {
  if (liquid_bodies(job).empty()) throw InputError("an exact flow needs a liquid");
}

Snapshot LiquidReference::fields(const std::vector<Vec3>& places, double time) const {
  Snapshot out;
  out.time = time;
  bool velocity = false, pressure = false, density = false;
  for (std::size_t i = 0; i < std::min(places.size(), initial_.size()); ++i) {
    const LiquidState s = is_liquid(i) ? state(places[i], time, i) : LiquidState{};
    out.velocity.push_back(s.velocity);
    velocity |= finite(s.velocity);
    out.pressure.push_back(s.pressure);
    pressure |= std::isfinite(s.pressure);
    out.density.push_back(s.density);
    density |= std::isfinite(s.density);
  }
  if (!velocity) out.velocity.clear();  // a column without any known value is left out
  if (!pressure) out.pressure.clear();
  if (!density) out.density.clear();
  out.phase = initial_.phase;
  out.body = initial_.body;
  out.bodies = bodies(time);
  return out;
}

}  // namespace tripoint
