// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/predicted_velocities.hpp"

#include <utility>

#include "state/body_table.hpp"
#include "state/free_rows.hpp"

namespace tripoint::liquid {

void predict_velocities(State& state, double ahead, const VectorField<double>& target) {
  Particles& p = state.particles;
  const FreeRows rows = free_rows(state);
  const FreeLoops loops = free_loops(rows.forces);
  const auto seen = triple(p, target);
  const auto x = positions(p), v = velocities(p);
  const auto body = p[field::body];
  const RigidMembers is_member(state);
  const auto of_bodies = [&](const Field<Vec3>& f) {
    return state.bodies.size() > 0 ? std::as_const(state.bodies)[f] : std::span<const Vec3>{};
  };
  const auto centre = of_bodies(field::body_centre), velocity = of_bodies(field::body_velocity),
             omega = of_bodies(field::body_angular_velocity);
  const auto gained = of_bodies(field::body_acceleration),
             turned = of_bodies(field::body_angular_acceleration);
  const auto of_member = [&](std::size_t i) {
    const auto b = static_cast<std::size_t>(body[i]);
    const Vec3 arm = (state.box.any() ? state.unwrapped(i) : x.at(i)) - centre[b];
    seen.set(i, velocity[b] + ahead * gained[b] + cross(omega[b] + ahead * turned[b], arm));
  };
  const auto of_others = [&](std::size_t from, std::size_t to) {
    if (ahead != 0.0) {
      loops.predict(rows, {v.x.data(), v.y.data(), v.z.data()}, {seen.x.data(), seen.y.data(), seen.z.data()},
                    ahead, from, to);
    } else {
      for (std::size_t i = from; i < to; ++i) seen.set(i, v.at(i));
    }
  };
  // Fixed particles are seen at rest
  each_block(p.moving(), state.threads,
             [&](std::size_t from, std::size_t to) { is_member.each_run(from, to, of_member, of_others); });
}

}  // namespace tripoint::liquid
