// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "state/state.hpp"

/// The table of solid bodies, one row for each that ever existed: rigid ones move as one, deformable ones by
/// their particles.
namespace tripoint {

/// Columns that every scene with solids has.
[[nodiscard]] std::vector<FieldInfo> body_table_fields();
/// Of these those whose whole numbers stand for something.
[[nodiscard]] std::vector<Bounded> body_table_bounds();
/// Whether the scene has solid bodies, or can get some by freezing.
[[nodiscard]] bool can_have_bodies(const Scene&);

/// Whether it has, or can get by freezing, solids whose particles move by themselves.
[[nodiscard]] bool can_have_deformable_bodies(const Scene&);

/// Rows of the members of one body, in order of id.
[[nodiscard]] std::vector<std::size_t> members(const State&, std::size_t body);
/// The same of every body.
[[nodiscard]] std::vector<std::vector<std::size_t>> members_of_all(const State&);
[[nodiscard]] inline bool is_alive(const State& state, std::size_t body) {
  return state.bodies[field::body_alive][body] != 0;
}
/// Whether its particles move as one: a rigid body, or any that is fixed or prescribed.
[[nodiscard]] inline bool is_rigid(const State& state, std::size_t body) {
  return state.bodies[field::body_phase][body] == static_cast<int>(Phase::rigid);
}

/// Calls visit(body) for each one that this process keeps, alive or not, in order of rows.
template <class Visit>
void each_kept_body(const State& state, Visit visit) {
  if (state.body_owners.any()) {
    for (const std::size_t b : state.body_owners.kept()) visit(b);
  } else {
    for (std::size_t b = 0; b < state.bodies.size(); ++b) visit(b);
  }
}

/// A new row, alive, free, with identity orientation and no members yet. @return its row
std::size_t add_body(State&, std::string_view name, Phase phase);
/// One row for each solid body of the scene.
void add_scene_bodies(State&);
/// Row of the body with this name. @throws InputError when there is none, or it is gone
[[nodiscard]] std::size_t body_row(const State&, std::string_view name);

/// Tells of rows of particles whether they are members of rigid bodies; all others move by the forces on them
/// alone. Valid until bodies are added or particles sorted anew.
class RigidMembers {
 public:
  explicit RigidMembers(const State& state) : body_(state.particles[field::body]) {
    if (state.bodies.size() > 0) phase_ = state.bodies[field::body_phase];
    any_ = std::ranges::find(phase_, static_cast<int>(Phase::rigid)) != phase_.end();
  }
  [[nodiscard]] bool operator()(std::size_t row) const {
    return body_[row] >= 0 && phase_[static_cast<std::size_t>(body_[row])] == static_cast<int>(Phase::rigid);
  }
  /// Calls member(row) for each of the rows from..to-1 that is, and others(from, to) for each run of those
  /// that are not, in order.
  template <class Member, class Others>
  void each_run(std::size_t from, std::size_t to, Member member, Others others) const {
    if (!any_) return others(from, to);
    while (from < to) {
      if ((*this)(from)) {
        member(from++);
        continue;
      }
      std::size_t past = from + 1;
      while (past < to && !(*this)(past)) ++past;
      others(from, past);
      from = past;
    }
  }
  template <class Others>
  void each_run_of_others(std::size_t from, std::size_t to, Others others) const {
    each_run(
        from, to, [](std::size_t) {}, others);
  }

 private:
  std::span<const int> body_, phase_;
  bool any_ = false;  ///< rigid bodies
};

/// Motion of a deformable body as a whole, from its members: L/I for its spin.
struct WholeMotion {
  double mass = 0.0;            ///< [kg]
  Vec3 centre, velocity, spin;  ///< [m], [m/s], [rad/s]
};
/// @param place,velocity,mass of its members [m], [m/s], [kg]; none: all zero
[[nodiscard]] WholeMotion whole_motion(std::span<const Vec3> place, std::span<const Vec3> velocity,
                                       const std::vector<double>& mass);
[[nodiscard]] WholeMotion whole_motion(const State&, std::size_t body);

}  // namespace tripoint
