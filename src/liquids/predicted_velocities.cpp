// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/predicted_velocities.hpp"

#include <utility>

#include "state/body_table.hpp"
#include "state/free_rows.hpp"

namespace tripoint::liquid {
namespace {

/// Velocity of a body where one of its members is, some time ahead by the rates of the last forces.
class BodyVelocities {
 public:
  explicit BodyVelocities(const State& state)
      : state_(state),
        x_(positions(state.particles)),
        body_(state.particles[field::body]),
        centre_(of(field::body_centre)),
        velocity_(of(field::body_velocity)),
        omega_(of(field::body_angular_velocity)),
        gained_(of(field::body_acceleration)),
        turned_(of(field::body_angular_acceleration)) {}
  /// @pre the row is that of a member   @param ahead [s]
  [[nodiscard]] Vec3 at(std::size_t row, double ahead) const {
    const auto b = static_cast<std::size_t>(body_[row]);
    const Vec3 arm = (state_.box.any() ? state_.unwrapped(row) : x_.at(row)) - centre_[b];
    return velocity_[b] + ahead * gained_[b] + cross(omega_[b] + ahead * turned_[b], arm);
  }

 private:
  [[nodiscard]] std::span<const Vec3> of(const Field<Vec3>& f) const {
    return state_.bodies.size() > 0 ? state_.bodies[f] : std::span<const Vec3>{};
  }
  const State& state_;
  Triple<const double> x_;
  std::span<const int> body_;
  std::span<const Vec3> centre_, velocity_, omega_, gained_, turned_;
};

}  // namespace

void predict_velocities(State& state, double ahead, const VectorField<double>& target) {
  Particles& p = state.particles;
  const FreeRows rows = free_rows(state);
  const FreeLoops loops = free_loops(rows.forces);
  const auto seen = triple(p, target);
  const auto v = velocities(p);
  const BodyVelocities of_body(state);
  const RigidMembers is_member(state);
  const auto of_member = [&](std::size_t i) { seen.set(i, of_body.at(i, ahead)); };
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

void velocities_of_way(State& state, const VectorField<double>& target) {
  Particles& p = state.particles;
  const auto way = triple(p, target);
  const auto v = velocities(p);
  const BodyVelocities of_body(state);
  const RigidMembers is_member(state);
  const auto of_member = [&](std::size_t i) { way.set(i, 0.5 * (v.at(i) + of_body.at(i, 0.0))); };
  const auto of_others = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) way.set(i, v.at(i));
  };
  each_block(p.size(), state.threads,
             [&](std::size_t from, std::size_t to) { is_member.each_run(from, to, of_member, of_others); });
}

}  // namespace tripoint::liquid
