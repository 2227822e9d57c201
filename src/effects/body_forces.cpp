// SPDX-License-Identifier: BSD-3-Clause
#include "effects/body_forces.hpp"

#include "core/defect.hpp"

namespace tripoint {
namespace {

bool moves(const World& world, std::size_t b) {
  const Columns& t = world.bodies;
  const bool free = t[field::body_alive][b] != 0 && t[field::body_motion][b] == static_cast<int>(Motion::free);
  return free || t[field::body_velocity][b] != Vec3{} || t[field::body_angular_velocity][b] != Vec3{};
}

void sum_forces(const World& world, const std::vector<char>& asked, std::vector<BodyForces>& sums) {
  const Particles& p = world.particles;
  static const double weaker = 1.0 - defect_size("bodies.force"), turned = 1.0 - defect_size("bodies.torque");
  sums.assign(world.bodies.size(), {});
  const auto body = p[field::body];
  const auto F = triple(p, field::force_x, field::force_y, field::force_z);
  const auto D = triple(p, field::viscous_force_x, field::viscous_force_y, field::viscous_force_z);
  const auto centre = world.bodies[field::body_centre];
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (body[i] < 0 || !asked[static_cast<std::size_t>(body[i])]) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = world.unwrapped(i) - centre[b];
    const Vec3 pressure = weaker * F.at(i), viscous = weaker * D.at(i);
    sums[b].pressure += pressure;
    sums[b].viscous += viscous;
    sums[b].pressure_torque += turned * cross(arm, pressure);
    sums[b].viscous_torque += turned * cross(arm, viscous);
  }
}

}  // namespace

std::vector<BodyForces> forces_on_bodies(const World& world) {
  std::vector<BodyForces> sums;
  if (world.bodies.size() > 0 && world.particles.has(field::force_x.name)) sum_forces(world, std::vector<char>(world.bodies.size(), 1), sums);
  return sums;
}

void forces_on_moving_bodies(const World& world, std::vector<BodyForces>& sums) {
  sums.clear();
  if (world.bodies.size() == 0 || !world.particles.has(field::force_x.name)) return;
  std::vector<char> asked(world.bodies.size());
  bool any = false;
  for (std::size_t b = 0; b < asked.size(); ++b) {
    asked[b] = moves(world, b);
    any = any || asked[b];
  }
  if (any) sum_forces(world, asked, sums);
}

}  // namespace tripoint
