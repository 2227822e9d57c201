// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/way.hpp"

#include <utility>

#include "state/body_table.hpp"
#include "state/free_rows.hpp"

namespace tripoint::carried_liquid {

void set_velocities_of_way(State& state, const VectorField<double>& target) {
  Particles& p = state.particles;
  const auto way = triple(p, target);
  const auto x = positions(std::as_const(p)), v = velocities(std::as_const(p));
  const auto body = p[field::body];
  const RigidMembers is_member(state);
  const auto of_bodies = [&](const Field<Vec3>& f) {
    return state.bodies.size() > 0 ? std::as_const(state.bodies)[f] : std::span<const Vec3>{};
  };
  const auto centre = of_bodies(field::body_centre), velocity = of_bodies(field::body_velocity),
             omega = of_bodies(field::body_angular_velocity);
  const auto of_member = [&](std::size_t i) {
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = (state.box.any() ? state.unwrapped(i) : x.at(i)) - centre[b];
    way.set(i, 0.5 * (v.at(i) + (velocity[b] + cross(omega[b], arm))));
  };
  const auto of_others = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) way.set(i, v.at(i));
  };
  each_block(p.size(), state.threads,
             [&](std::size_t from, std::size_t to) { is_member.each_run(from, to, of_member, of_others); });
}

}  // namespace tripoint::carried_liquid
