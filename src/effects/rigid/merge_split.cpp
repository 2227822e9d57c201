// SPDX-License-Identifier: BSD-3-Clause
#include "effects/rigid/merge_split.hpp"

#include "core/errors.hpp"
#include "effects/rigid/bodies.hpp"
#include "scene/geometry.hpp"

namespace tripoint::rigid {
namespace {

/// Momentum and angular momentum about `centre` of bodies as they move.
struct Momenta {
  double kinetic = 0.0;
  Vec3 P, L;
};
Momenta momenta_of(const State& state, const std::vector<std::size_t>& bodies, const Vec3& centre) {
  Momenta sum;
  for (const std::size_t b : bodies) {
    const BodyMotion m = motion_of(state, b);
    sum.kinetic += kinetic_energy(state, b);
    sum.P += m.mass * m.velocity;
    sum.L += m.L + m.mass * cross(m.centre - centre, m.velocity);
  }
  return sum;
}

/// Momentum and angular momentum of a set of particles that move as `parent` does.
struct Share {
  double mass = 0.0;
  Vec3 P, moment;  ///< sum m v, sum m r x v
};
Share share_of(const State& state, const std::vector<std::size_t>& rows,
               const std::vector<BodyMotion>& parents, const std::vector<int>& parent_of) {
  Share sum;
  for (const std::size_t i : rows) {
    const BodyMotion& parent =
        parents[static_cast<std::size_t>(parent_of[static_cast<std::size_t>(state.particles[field::id][i])])];
    const double m = state.particles[field::mass][i];
    const Vec3 r = state.unwrapped(i), v = parent.velocity_at(r);
    sum.mass += m;
    sum.P += m * v;
    sum.moment += m * cross(r, v);
  }
  return sum;
}

/// Lets a body, already measured, move on with the momenta of its share.
void hand_on(State& state, std::size_t b, const Share& share) {
  Columns& t = state.bodies;
  t[field::body_velocity][b] = share.P / share.mass;
  t[field::body_angular_momentum][b] = share.moment - cross(t[field::body_centre][b], share.P);
  update_spin(state, b);
}

std::vector<std::size_t> bodies_of(const State& state, const Event& event) {
  std::vector<std::size_t> rows;
  for (const std::string& name : event.bodies) rows.push_back(body_row(state, name));
  for (std::size_t b = 0; event.bodies.empty() && b < state.bodies.size(); ++b) {
    if (is_alive(state, b) && is_rigid(state, b)) rows.push_back(b);
  }
  return rows;
}

/// Particles of the event's bodies that lie in its region become members of the body `born`. @return the
/// bodies that lost some
std::vector<std::size_t> cut_off(State& state, const Event& event, std::size_t born) {
  const auto inside = inside_region(state.scene, *event.region);
  const auto body = state.particles[field::body];
  std::vector<std::size_t> losers;
  for (const std::size_t b : bodies_of(state, event)) {
    bool touched = false;
    for (const std::size_t i : members(state, b)) {
      if (!inside(state.unwrapped(i))) continue;
      body[i] = static_cast<int>(born);
      touched = true;
    }
    if (touched) losers.push_back(b);
  }
  if (losers.empty())
    throw InputError(event.place,
                     "split: no member of a body is in the region of " + event.name + " at that time");
  return losers;
}

}  // namespace

void merge(State& state, const Event& event) {
  const std::vector<std::size_t> bodies = bodies_of(state, event);
  if (bodies.size() < 2)
    throw InputError(event.place, "merge needs two bodies: bodies = [\"that stays\", \"that joins\"]");
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    if (is_free(state, bodies[n])) continue;
    throw InputError(event.place, "merge: name the fixed or prescribed body " + state.body_names[bodies[n]] +
                                      " first: it is the one that stays");
  }
  const std::size_t stays = bodies[0];
  const bool free = is_free(state, stays);
  const Momenta before = momenta_of(state, bodies, {});
  const auto body = state.particles[field::body];
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    for (const std::size_t i : members(state, bodies[n])) body[i] = static_cast<int>(stays);
    measure(state, bodies[n]);
  }
  const BodyMotion old = motion_of(state, stays);
  measure(state, stays);
  Columns& t = state.bodies;
  const Vec3 centre = t[field::body_centre][stays];
  if (free) {
    t[field::body_velocity][stays] = before.P / t[field::body_mass][stays];
    t[field::body_angular_momentum][stays] = before.L - cross(centre, before.P);
    update_spin(state, stays);
  } else {
    go_on_driven(state, stays, old);
  }
  state.accumulated[account::merging] += before.kinetic - kinetic_energy(state, stays);
  give_velocities(state);
}

void split(State& state, const Event& event) {
  if (!event.region)
    throw InputError(event.place, "split needs a region: its members become the body " + event.name);
  std::vector<BodyMotion> parents;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) parents.push_back(motion_of(state, b));
  const auto body = state.particles[field::body];
  std::vector<int> parent_of(state.particles.size(), -1);
  for (std::size_t i = 0; i < body.size(); ++i)
    parent_of[static_cast<std::size_t>(state.particles[field::id][i])] = body[i];
  const std::size_t born = state.bodies.size();
  const std::vector<std::size_t> changed = cut_off(state, event, born);
  Vec3 delivered, owed;
  double kinetic = 0.0;
  for (const std::size_t b : changed) {
    owed += parents[b].L + parents[b].mass * cross(parents[b].centre, parents[b].velocity);
    kinetic += kinetic_energy(state, b);
  }
  add_body(state, event.name, Phase::rigid);
  measure(state, born);
  state.bodies[field::body_offset][born] = {};
  hand_on(state, born, share_of(state, members(state, born), parents, parent_of));
  const auto deliver = [&](std::size_t b) {
    const BodyMotion m = motion_of(state, b);
    delivered += m.L + m.mass * cross(m.centre, m.velocity);
    kinetic -= kinetic_energy(state, b);
  };
  deliver(born);
  for (const std::size_t b : changed) {
    const bool free = is_free(state, b);
    measure(state, b);
    if (!is_alive(state, b)) continue;
    if (free) {
      hand_on(state, b, share_of(state, members(state, b), parents, parent_of));
    } else {
      go_on_driven(state, b, parents[b]);
    }
    deliver(b);
  }
  state.accumulated.undelivered_spin += owed - delivered;
  state.accumulated[account::walls] += kinetic;
  give_velocities(state);
}

}  // namespace tripoint::rigid
