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
Momenta momenta_of(const World& world, const std::vector<std::size_t>& bodies, const Vec3& centre) {
  Momenta sum;
  for (const std::size_t b : bodies) {
    const BodyMotion m = motion_of(world, b);
    sum.kinetic += kinetic_energy(world, b);
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
Share share_of(const World& world, const std::vector<std::size_t>& rows,
               const std::vector<BodyMotion>& parents, const std::vector<int>& parent_of) {
  Share sum;
  for (const std::size_t i : rows) {
    const BodyMotion& parent =
        parents[static_cast<std::size_t>(parent_of[static_cast<std::size_t>(world.particles[field::id][i])])];
    const double m = world.particles[field::mass][i];
    const Vec3 r = world.unwrapped(i), v = parent.velocity_at(r);
    sum.mass += m;
    sum.P += m * v;
    sum.moment += m * cross(r, v);
  }
  return sum;
}

/// Lets a body, already measured, move on with the momenta of its share.
void hand_on(World& world, std::size_t b, const Share& share) {
  Columns& t = world.bodies;
  t[field::body_velocity][b] = share.P / share.mass;
  t[field::body_angular_momentum][b] = share.moment - cross(t[field::body_centre][b], share.P);
  update_spin(world, b);
}

std::vector<std::size_t> bodies_of(const World& world, const Event& event) {
  std::vector<std::size_t> rows;
  for (const std::string& name : event.bodies) rows.push_back(body_row(world, name));
  for (std::size_t b = 0; event.bodies.empty() && b < world.bodies.size(); ++b) {
    if (is_alive(world, b) && is_rigid(world, b)) rows.push_back(b);
  }
  return rows;
}

/// Particles of the event's bodies that lie in its region become members of the body `born`. @return the
/// bodies that lost some
std::vector<std::size_t> cut_off(World& world, const Event& event, std::size_t born) {
  const auto inside = inside_of(*event.region, world.scene.spacing);
  const auto body = world.particles[field::body];
  std::vector<std::size_t> losers;
  for (const std::size_t b : bodies_of(world, event)) {
    bool touched = false;
    for (const std::size_t i : members(world, b)) {
      if (!inside(world.unwrapped(i))) continue;
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

void merge(World& world, const Event& event) {
  const std::vector<std::size_t> bodies = bodies_of(world, event);
  if (bodies.size() < 2)
    throw InputError(event.place, "merge needs two bodies: bodies = [\"that stays\", \"that joins\"]");
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    if (is_free(world, bodies[n])) continue;
    throw InputError(event.place, "merge: name the fixed or prescribed body " + world.body_names[bodies[n]] +
                                      " first: it is the one that stays");
  }
  const std::size_t stays = bodies[0];
  const bool free = is_free(world, stays);
  const Momenta before = momenta_of(world, bodies, {});
  const auto body = world.particles[field::body];
  for (std::size_t n = 1; n < bodies.size(); ++n) {
    for (const std::size_t i : members(world, bodies[n])) body[i] = static_cast<int>(stays);
    measure(world, bodies[n]);
  }
  const BodyMotion old = motion_of(world, stays);
  measure(world, stays);
  Columns& t = world.bodies;
  const Vec3 centre = t[field::body_centre][stays];
  if (free) {
    t[field::body_velocity][stays] = before.P / t[field::body_mass][stays];
    t[field::body_angular_momentum][stays] = before.L - cross(centre, before.P);
    update_spin(world, stays);
  } else {
    go_on_driven(world, stays, old);
  }
  world.booked[account::merging] += before.kinetic - kinetic_energy(world, stays);
  give_velocities(world);
}

void split(World& world, const Event& event) {
  if (!event.region)
    throw InputError(event.place, "split needs a region: its members become the body " + event.name);
  std::vector<BodyMotion> parents;
  for (std::size_t b = 0; b < world.bodies.size(); ++b) parents.push_back(motion_of(world, b));
  const auto body = world.particles[field::body];
  std::vector<int> parent_of(world.particles.size(), -1);
  for (std::size_t i = 0; i < body.size(); ++i)
    parent_of[static_cast<std::size_t>(world.particles[field::id][i])] = body[i];
  const std::size_t born = world.bodies.size();
  const std::vector<std::size_t> changed = cut_off(world, event, born);
  Vec3 delivered, owed;
  double kinetic = 0.0;
  for (const std::size_t b : changed) {
    owed += parents[b].L + parents[b].mass * cross(parents[b].centre, parents[b].velocity);
    kinetic += kinetic_energy(world, b);
  }
  add_body(world, event.name, Phase::rigid);
  measure(world, born);
  world.bodies[field::body_offset][born] = {};
  hand_on(world, born, share_of(world, members(world, born), parents, parent_of));
  const auto deliver = [&](std::size_t b) {
    const BodyMotion m = motion_of(world, b);
    delivered += m.L + m.mass * cross(m.centre, m.velocity);
    kinetic -= kinetic_energy(world, b);
  };
  deliver(born);
  for (const std::size_t b : changed) {
    const bool free = is_free(world, b);
    measure(world, b);
    if (!is_alive(world, b)) continue;
    if (free) {
      hand_on(world, b, share_of(world, members(world, b), parents, parent_of));
    } else {
      go_on_driven(world, b, parents[b]);
    }
    deliver(b);
  }
  world.booked.undelivered_spin += owed - delivered;
  world.booked[account::walls] += kinetic;
  give_velocities(world);
}

}  // namespace tripoint::rigid
