// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/walls.hpp"

#include <algorithm>

#include "effects/fluid/fluid_terms.hpp"

namespace tripoint::fluid {
namespace {

bool is_wall(const World& world, std::size_t row) {
  const int body = world.particles[field::body][row];
  return body >= 0 && world.bodies[field::body_motion][static_cast<std::size_t>(body)] != static_cast<int>(Motion::free);
}

}  // namespace

Vec3 wall_acceleration(const World& world, std::size_t row) {
  const auto b = static_cast<std::size_t>(world.particles[field::body][row]);
  const Vec3 omega = world.bodies[field::body_angular_velocity][b];
  return cross(omega, cross(omega, world.particles.position(row) - world.bodies[field::body_centre][b]));
}

void extrapolate_to_walls(World& world, const SceneNumbers& n, const PairKernels& kernels) {
  Particles& p = world.particles;
  for (const Field<double>* f : {&field::wall_weight, &field::wall_pressure, &field::wall_lever_x, &field::wall_lever_y, &field::wall_lever_z,
                                 &field::wall_velocity_x, &field::wall_velocity_y, &field::wall_velocity_z})
    std::ranges::fill(p[*f], 0.0);
  static const Pass<Slot<None, WallExtrapolation>> pass({Form::corrected});
  pass(p, *world.neighbours, kernels, world.threads);

  const auto weight = p[field::wall_weight], sum = p[field::wall_pressure];
  const auto lever = triple(p, field::wall_lever_x, field::wall_lever_y, field::wall_lever_z);
  const auto moved = triple(p, field::wall_velocity_x, field::wall_velocity_y, field::wall_velocity_z);
  const auto seen = triple(p, field::viscous_velocity_x, field::viscous_velocity_y, field::viscous_velocity_z);
  const auto pressure = p[field::pressure];
#pragma omp parallel for schedule(static) num_threads(world.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_wall(world, i) || !(weight[i] > 0.0)) continue;
    seen.set(i, 2.0 * p.velocity(i) - moved.at(i) / weight[i]);
    if (!n.extrapolates) continue;
    const double p_w = (sum[i] + dot(world.scene.gravity - wall_acceleration(world, i), lever.at(i))) / weight[i];
    pressure[i] = world.scene.clamp ? std::max(p_w, 0.0) : p_w;
  }
}

}  // namespace tripoint::fluid
