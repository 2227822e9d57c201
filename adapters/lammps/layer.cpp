// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tripoint::lammps {
namespace {

/// Place in the plane, in hundredths of a spacing.
std::array<long, 3> column_of(const InitialState& state, std::size_t i, double spacing) {
  return {std::lround(100.0 * state.position[i].x / spacing),
          std::lround(100.0 * state.position[i].y / spacing), state.source[i]};
}

template <class T>
void take(std::vector<T>& to, const std::vector<T>& from, std::size_t i) {
  if (!from.empty()) to.push_back(from[i]);
}

}  // namespace

std::string why_no_layer(const Job& job) {
  const Scene& scene = job.scene;
  if (scene.periodic[0] || scene.periodic[1])
    return "smd/tlsph takes present distances without the periodic image: bodies across a periodic boundary "
           "fly apart; along z "
           "alone one layer is run in plane strain";
  if (scene.jitter > 0.0)
    return "smd/tlsph is run in one layer where z is periodic, and the particles are jittered";
  if (scene.gravity.z != 0.0)
    return "smd/tlsph is run in one layer where z is periodic, and gravity acts along z";
  for (const Body& b : scene.bodies)
    if (b.velocity.value.z != 0.0 || b.angular_velocity.x != 0.0 || b.angular_velocity.y != 0.0)
      return fmt::format("smd/tlsph is run in one layer where z is periodic, and {} moves out of it", b.name);
  return {};
}

Layer lowest_layer(const Job& job, const InitialState& whole) {
  Layer layer;
  std::map<std::array<long, 3>, std::size_t> rows;
  const double bottom =
      std::min_element(whole.position.begin(), whole.position.end(), [](const Vec3& a, const Vec3& b) {
        return a.z < b.z;
      })->z;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole.position[i].z > bottom + 0.01 * job.scene.spacing) continue;
    rows[column_of(whole, i, job.scene.spacing)] = layer.state.size();
    take(layer.state.position, whole.position, i);
    take(layer.state.velocity, whole.velocity, i);
    take(layer.state.mass, whole.mass, i);
    take(layer.state.temperature, whole.temperature, i);
    take(layer.state.phase, whole.phase, i);
    take(layer.state.body, whole.body, i);
    take(layer.state.material, whole.material, i);
    take(layer.state.source, whole.source, i);
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto found = rows.find(column_of(whole, i, job.scene.spacing));
    if (found == rows.end() || norm(whole.velocity[i] - layer.state.velocity[found->second]) > 0.0)
      throw EngineError("the scene is not the same all along its periodic direction z");
    layer.row.push_back(found->second);
  }
  layer.count = whole.size() / layer.state.size();
  if (layer.count * layer.state.size() != whole.size())
    throw EngineError("the scene is not the same all along its periodic direction z");
  return layer;
}

Snapshot all_layers(const Layer& layer, const InitialState& whole, const Snapshot& one) {
  Snapshot s;
  s.time = one.time;
  s.step = one.step;
  s.phase = whole.phase;
  s.body = whole.body;
  s.material = whole.material;
  s.mass = whole.mass;
  for (const auto& [term, energy] : one.energy) s.energy[term] = static_cast<double>(layer.count) * energy;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const std::size_t row = layer.row[i];
    s.id.push_back(static_cast<int>(i));
    s.position.push_back({one.position[row].x, one.position[row].y, whole.position[i].z});
    s.velocity.push_back(one.velocity[row]);
    s.total_mass += s.mass[i];
    s.momentum += s.mass[i] * s.velocity[i];
    s.angular_momentum += s.mass[i] * cross(s.position[i], s.velocity[i]);
  }
  return s;
}

}  // namespace tripoint::lammps
