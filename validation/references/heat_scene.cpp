// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/heat_scene.hpp"
#include "files/job.hpp"
#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tripoint {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const Material& material_of(const Job& job, std::size_t body) {
  const auto& name = job.bodies.at(body).material;
  const auto& list = job.scene.materials;
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Material& m) { return m.name == name; });
  if (found == list.end())
    throw InputError("body `" + job.bodies[body].name + "` is of material `" + name +
                     "`, which the scene does not have");
  if (!found->conductivity || !found->heat_capacity)
    throw InputError("material `" + name +
                     "` needs conductivity and heat_capacity for an exact solution of heat");
  return *found;
}

}  // namespace

BarAxis body_along(std::size_t axis, std::size_t body, const Job& job, const InitialState& initial) {
  BarAxis bar{axis, infinity, -infinity, false};
  if (body < job.scene.bodies.size() && is_upright_box(job.scene.bodies[body].shape)) {
    const auto& box = job.scene.bodies[body].shape;
    if (box.max[axis] > box.min[axis]) return {axis, box.min[axis], box.max[axis], false};
  }
  for (std::size_t i = 0; i < initial.size(); ++i) {
    if (initial.source[i] != static_cast<int>(body)) continue;
    bar.low = std::min(bar.low, initial.position[i][axis] - 0.5 * job.scene.spacing);
    bar.high = std::max(bar.high, initial.position[i][axis] + 0.5 * job.scene.spacing);
  }
  if (!(bar.high > bar.low)) throw InputError("body `" + job.bodies.at(body).name + "` has no particles");
  return bar;
}

BarAxis bar_along(std::size_t axis, const Job& job, const InitialState& initial) {
  if (job.scene.periodic[axis]) {
    if (!job.scene.min || !job.scene.max)
      throw InputError("a periodic direction needs scene.min and scene.max");
    return {axis, (*job.scene.min)[axis], (*job.scene.max)[axis], true};
  }
  BarAxis bar{axis, infinity, -infinity, false};
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    const auto one = body_along(axis, b, job, initial);
    bar.low = std::min(bar.low, one.low);
    bar.high = std::max(bar.high, one.high);
  }
  return bar;
}

std::size_t axis_of(const Vec3& direction, const std::string& what) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(direction[i]) > std::abs(direction[k])) k = i;
  const Vec3 rest =
      direction - Vec3{k == 0 ? direction.x : 0.0, k == 1 ? direction.y : 0.0, k == 2 ? direction.z : 0.0};
  if (direction[k] == 0.0 || norm(rest) > 1e-12 * norm(direction))
    throw InputError(what + " must point along x, y or z");
  return k;
}

PhaseValues phase_values(const Job& job, std::size_t body, Phase phase) {
  const auto& m = material_of(job, body);
  if (phase == Phase::liquid) return {*m.conductivity, m.density * *m.heat_capacity};
  return {m.solid_conductivity.value_or(*m.conductivity),
          m.density * m.solid_heat_capacity.value_or(*m.heat_capacity)};
}

double diffusivity(const Job& job, std::size_t body) {
  return phase_values(job, body, job.bodies[body].phase).diffusivity();
}

double effusivity(const Job& job, std::size_t body) {
  const auto values = phase_values(job, body, job.bodies[body].phase);
  return std::sqrt(values.conductivity * values.heat_per_volume);
}

double common_diffusivity(const Job& job) {
  if (job.bodies.empty()) throw InputError("a scene without bodies has no heat");
  const double first = diffusivity(job, 0);
  for (std::size_t b = 1; b < job.bodies.size(); ++b)
    if (std::abs(diffusivity(job, b) - first) > 1e-12 * first)
      throw InputError("the bodies differ in diffusivity: this exact solution holds for one");
  return first;
}

HeatReference::HeatReference(const Job& job, const InitialState& initial, HeldEnds held) : initial_(initial) {
  for (const auto& body : job.bodies) {
    const bool at_rest =
        body.motion == Motion::fixed ||
        (norm(body.velocity) == 0.0 && norm(body.angular_velocity) == 0.0 && body.keyframes.empty());
    if (!at_rest)
      throw InputError("body `" + body.name + "` moves: the exact solutions of heat are of a medium at rest");
    if (body.temperature_held && held == HeldEnds::refused)
      throw InputError("body `" + body.name +
                       "` holds its temperature: this exact solution is of an insulated or periodic medium");
    if (body.motion == Motion::free && norm(job.scene.gravity) > 0.0)
      throw InputError("body `" + body.name + "` falls: the exact solutions of heat are of a medium at rest");
  }
  if (!job.scene.events.empty() || !job.scene.inflows.empty() || !job.scene.sources.empty())
    throw InputError("an exact solution of heat has no events, inflows or sources");
  rest_.position = initial.position;
  rest_.velocity.assign(initial.size(), Vec3{});
  rest_.phase = initial.phase;
  rest_.body = initial.body;
  for (const auto& body : job.bodies) {
    if (body.index < 0) continue;
    BodyState state;
    state.position = body.properties.centre;
    state.mass = body.properties.mass;
    rest_.bodies.push_back(state);
  }
}

Snapshot HeatReference::at(double time) const {
  Snapshot out = rest_;
  out.time = time;
  for (const auto& r : initial_.position) out.temperature.push_back(temperature(r, time));
  return out;
}

}  // namespace tripoint
