// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/predicted_velocities.hpp"

#include <utility>

#include "effects/carried_liquid/fields.hpp"
#include "world/body_table.hpp"
#include "world/free_rows.hpp"

namespace tripoint::carried_liquid {

void predict_velocities(World& world, double ahead) {
  Particles& p = world.particles;
  const FreeRows rows = free_rows(world);
  const FreeLoops loops = free_loops(rows.forces);
  const auto seen = triple(p, field::predicted_x, field::predicted_y, field::predicted_z);
  const auto v = velocities(std::as_const(p));
  const auto body = p[field::body];
  const RigidMembers is_member(world);
  const auto of_member = [&](std::size_t i) {
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = world.unwrapped(i) - world.bodies[field::body_centre][b];
    seen.set(i,
             world.bodies[field::body_velocity][b] + ahead * world.bodies[field::body_acceleration][b] +
                 cross(world.bodies[field::body_angular_velocity][b] + ahead * world.bodies[field::body_angular_acceleration][b],
                       arm));
  };
  const auto of_others = [&](std::size_t from, std::size_t to) {
    if (ahead != 0.0)
      loops.predict(rows, {v.x.data(), v.y.data(), v.z.data()}, {seen.x.data(), seen.y.data(), seen.z.data()}, ahead, from, to);
    else
      for (std::size_t i = from; i < to; ++i) seen.set(i, v.at(i));
  };
  each_block(p.moving(), world.threads,
             [&](std::size_t from, std::size_t to) { is_member.each_run(from, to, of_member, of_others); });
}

}  // namespace tripoint::carried_liquid
