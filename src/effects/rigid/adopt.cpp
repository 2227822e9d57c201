// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/adopt.hpp"

#include <map>

#include "effects/rigid/bodies.hpp"

namespace tripoint::rigid {
namespace {

/// A body as it was before the change.
struct Former {
  BodyMotion motion;
  bool driven = false;
  Vec3 undelivered;  ///< angular momentum about truncated axes, which turns nothing [kg m2/s]
};

class Adoption {
 public:
  explicit Adoption(State& state) : state_(state) {}
  void run();

 private:
  void remember();
  void list_members();
  void release();
  void measure_anew(std::size_t body);
  void hand_over_undelivered();
  /// Velocity of a particle just before the change [m/s].
  [[nodiscard]] Vec3 velocity_of(std::size_t row, int parent) const;
  [[nodiscard]] int parent_of(std::size_t row, int now) const;

  State& state_;
  std::map<std::size_t, Former> before_;  ///< rigid bodies by row
  /// Members now, of each changed rigid body, in order of id
  std::map<std::size_t, std::vector<std::size_t>> rows_;
  /// Of each former body: where its member of lowest id is now
  std::map<std::size_t, std::size_t> heir_;
};

void Adoption::remember() {
  const auto keep = [&](std::size_t b) {
    if (!is_rigid(state_, b) || before_.contains(b)) return;
    const BodyMotion m = motion_of(state_, b);
    const bool driven = state_.bodies[field::body_motion][b] != static_cast<int>(Motion::free);
    before_[b] = {m, driven, driven || m.mass == 0.0 ? Vec3{} : m.L - spin_momentum(state_, b)};
  };
  for (const std::size_t b : state_.change.bodies) keep(b);
  for (const auto& [id, b] : state_.change.came_from)
    if (b >= 0) keep(static_cast<std::size_t>(b));
}

void Adoption::list_members() {
  for (const std::size_t b : state_.change.bodies)
    if (is_rigid(state_, b)) rows_[b];
  std::vector<char> asked(state_.bodies.size(), 0);
  for (const auto& [b, rows] : rows_) asked[b] = 1;
  const auto body = state_.particles[field::body];
  for (std::size_t id = 0; id < body.size(); ++id) {
    const std::size_t i = state_.particles.row(id);
    if (body[i] < 0 || !asked[static_cast<std::size_t>(body[i])]) continue;
    const auto b = static_cast<std::size_t>(body[i]);
    rows_[b].push_back(i);
    if (const int parent = parent_of(i, body[i]); parent >= 0)
      heir_.try_emplace(static_cast<std::size_t>(parent), b);
  }
}

int Adoption::parent_of(std::size_t row, int now) const {
  const auto at = state_.change.came_from.find(static_cast<std::uint32_t>(state_.particles[field::id][row]));
  return at == state_.change.came_from.end() ? now : at->second;
}

Vec3 Adoption::velocity_of(std::size_t row, int parent) const {
  const auto at = parent >= 0 ? before_.find(static_cast<std::size_t>(parent)) : before_.end();
  if (at == before_.end()) return state_.particles.velocity(row);
  return at->second.motion.velocity_at(state_.unwrapped(row));
}

/// Particles that melted from a rigid body, or turned elastic, keep the velocity that the body gave them.
void Adoption::release() {
  const auto v = velocities(state_.particles);
  for (const auto* list : {&state_.change.melted, &state_.change.frozen}) {
    for (const std::uint32_t id : *list) {
      const std::size_t i = state_.particles.row(id);
      v.set(i, velocity_of(i, parent_of(i, -1)));
    }
  }
}

void Adoption::measure_anew(std::size_t b) {
  const std::vector<std::size_t>& rows = rows_.at(b);
  Columns& t = state_.bodies;
  measure(state_, b, rows);
  if (rows.empty()) return;
  const auto v = velocities(state_.particles);
  const auto m = state_.particles[field::mass];
  const auto body = state_.particles[field::body];
  const Vec3 centre = t[field::body_centre][b];
  const Former& old = before_.at(b);
  if (old.motion.mass == 0.0) t[field::body_offset][b] = {};  // born just now
  Vec3 P, L;
  double kinetic = 0.0, in_its_frame = 0.0;
  for (const std::size_t i : rows) {
    const Vec3 r = state_.unwrapped(i), w = velocity_of(i, parent_of(i, body[i])),
               relative = w - old.motion.velocity_at(r);
    v.set(i, w);
    P += m[i] * w;
    L += m[i] * cross(r - centre, w);
    kinetic += 0.5 * m[i] * dot(w, w);
    in_its_frame += 0.5 * m[i] * dot(relative, relative);
  }
  if (old.driven) {
    go_on_driven(state_, b, old.motion);
    state_.change.kinetic_lost[b] = in_its_frame;
    state_.accumulated[account::walls] += kinetic - in_its_frame - kinetic_energy(state_, b);
  } else {
    t[field::body_velocity][b] = P / t[field::body_mass][b];
    t[field::body_angular_momentum][b] = L;
    state_.change.kinetic_lost[b] = kinetic;  // less the rest, when L is whole
  }
}

void Adoption::hand_over_undelivered() {
  for (const auto& [b, old] : before_) {
    if (old.undelivered == Vec3{}) continue;
    const bool stays = rows_.contains(b) && !rows_.at(b).empty();
    const auto heir = heir_.find(b);
    if (stays)
      state_.bodies[field::body_angular_momentum][b] += old.undelivered;
    else if (heir != heir_.end() && !before_.at(heir->second).driven)
      state_.bodies[field::body_angular_momentum][heir->second] += old.undelivered;
    else
      state_.accumulated.undelivered_spin += old.undelivered;
  }
}

void Adoption::run() {
  remember();
  list_members();
  release();
  for (const auto& [b, rows] : rows_) measure_anew(b);
  hand_over_undelivered();
  for (const auto& [b, rows] : rows_) {
    if (rows.empty() || before_.at(b).driven) continue;
    update_spin(state_, b);
    state_.change.kinetic_lost[b] -= kinetic_energy(state_, b);
  }
  give_velocities(state_);
}

}  // namespace

void adopt_members(State& state) {
  if (!state.change.bodies.empty()) Adoption(state).run();
}

}  // namespace tripoint::rigid
