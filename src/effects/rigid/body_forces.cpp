// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/body_forces.hpp"

namespace tripoint::rigid {

std::vector<BodyForces> forces_on_bodies(const World& world) {
  const Particles& p = world.particles;
  if (!p.has(field::force_x.name)) return {};
  std::vector<BodyForces> sums(world.bodies.size());
  const auto body = p[field::body];
  const auto F = triple(p, field::force_x, field::force_y, field::force_z);
  const auto D = triple(p, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z);
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = world.unwrapped(i) - world.bodies[field::body_centre][b];
    const Vec3 pressure = F.at(i), viscous = D.at(i);
    sums[b].pressure += pressure;
    sums[b].viscous += viscous;
    sums[b].pressure_torque += cross(arm, pressure);
    sums[b].viscous_torque += cross(arm, viscous);
  }
  return sums;
}

}  // namespace tripoint::rigid
