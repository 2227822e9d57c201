// SPDX-License-Identifier: BSD-3-Clause
// Merge and split: bodies are taken out of Bullet's world and others put in. They have the momenta of the
// very particles, so that P and L hold to round-off. (A btFixedConstraint between two bodies would lose
// angular momentum.)
#include <fmt/format.h>

#include <algorithm>

#include "adapters/bullet/bullet_engine.hpp"
#include "sampling/sample.hpp"
#include "scene/geometry.hpp"

namespace tripoint::bullet {
namespace {

/// w = I^-1 L in principal axes; no spin about an axis without a moment. [rad/s], world frame
Vec3 spin_of(const MassProperties& p, const Vec3& angular_momentum) {
  Vec3 w = rotate_back(p.principal_axes, angular_momentum);
  for (std::size_t k = 0; k < 3; ++k)
    w[k] = p.principal_inertia[k] > 0.0 ? w[k] / p.principal_inertia[k] : 0.0;
  return rotate(p.principal_axes, w);
}

Piece to_world(const Piece& piece, const RigidMotion& m) {
  Piece out = piece;
  out.centre = m.centre + rotate(m.orientation, piece.centre);
  out.rotation = m.orientation * piece.rotation;
  return out;
}
Piece to_frame(const Piece& piece, const Vec3& centre, const Quaternion& axes) {
  Piece out = piece;
  out.centre = rotate_back(axes, piece.centre - centre);
  out.rotation = conjugate(axes) * piece.rotation;
  return out;
}

}  // namespace

void BulletEngine::apply(const Event& event) {
  if (event.kind == Event::Kind::merge)
    merge(event);
  else
    split(event);
}

BulletEngine::Row& BulletEngine::alive(const std::string& name) {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == name && r.handle >= 0; });
  if (found == rows_.end()) throw EngineError(fmt::format("no body '{}' at t = {} s", name, time_));
  return *found;
}

Quaternion BulletEngine::orientation(const Row& r) const {
  return world_->motion(r.handle).orientation * conjugate(r.frame);
}

void BulletEngine::take_out(Row& r) {
  world_->remove(r.handle);
  r.handle = -1;
}

/// Makes the row a body of the given particles with their momenta.
/// @param now all particles, as they are   @param axes orientation that the row goes on with; (1,0,0,0) at a
/// birth
void BulletEngine::launch(Row& r, std::vector<int> members, const Snapshot& now, const Quaternion& axes,
                          const std::vector<Piece>& world_pieces) {
  std::sort(members.begin(), members.end());
  std::vector<Vec3> at;
  std::vector<double> mass;
  for (const int i : members) {
    at.push_back(now.position[static_cast<std::size_t>(i)]);
    mass.push_back(now.mass[static_cast<std::size_t>(i)]);
  }
  const MassProperties p = mass_properties(at, mass);
  Vec3 momentum, angular_momentum;  // about the new centre
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Vec3 mv = mass[k] * now.velocity[static_cast<std::size_t>(members[k])];
    momentum += mv;
    angular_momentum += cross(at[k] - p.centre, mv);
  }
  r.properties = p;
  r.frame = conjugate(axes) * p.principal_axes;
  r.members = std::move(members);
  set_arms(r, at, p.centre, p.principal_axes);
  r.pieces.clear();
  for (const Piece& piece : world_pieces) r.pieces.push_back(to_frame(piece, p.centre, p.principal_axes));
  enter(r, {p.centre, p.principal_axes, momentum / p.mass, spin_of(p, angular_momentum)});
}

/// bodies[0] absorbs the rest and goes on with its own orientation.
void BulletEngine::merge(const Event& event) {
  const Snapshot now = observe();
  Row& keeper = alive(event.bodies.front());
  const Quaternion axes = orientation(keeper);
  std::vector<int> members;
  std::vector<Piece> pieces;
  for (const std::string& name : event.bodies) {
    Row& r = alive(name);
    const RigidMotion m = world_->motion(r.handle);
    for (const Piece& piece : r.pieces) pieces.push_back(to_world(piece, m));
    members.insert(members.end(), r.members.begin(), r.members.end());
    take_out(r);
  }
  launch(keeper, members, now, axes, pieces);
}

/// One piece a particle, along the lattice axes of the body that it was in. [world frame]
std::vector<Piece> BulletEngine::world_pieces(const std::vector<int>& members, const Snapshot& now,
                                              const Quaternion& lattice) const {
  std::vector<Piece> pieces;
  for (const int i : members) {
    Piece piece = particle_piece();
    piece.centre = now.position[static_cast<std::size_t>(i)];
    piece.rotation = lattice;
    pieces.push_back(piece);
  }
  return pieces;
}

/// Members in the region, of the bodies named or of all, become a new body; the rest goes on in its own row.
void BulletEngine::split(const Event& event) {
  if (!event.region) throw EngineError(fmt::format("the split at t = {} s has no region", event.time));
  const Snapshot now = observe();
  const auto inside = inside_of(*event.region, job_.resolution.spacing);
  Row child;
  child.name = event.name;
  std::vector<int> leaving;
  std::vector<Piece> pieces;
  for (Row& r : rows_) {
    const bool named = event.bodies.empty() ||
                       std::find(event.bodies.begin(), event.bodies.end(), r.name) != event.bodies.end();
    if (r.handle < 0 || r.motion != Motion::free || !named) continue;
    std::vector<int> staying, parting;
    for (const int i : r.members)
      (inside(now.position[static_cast<std::size_t>(i)]) ? parting : staying).push_back(i);
    if (parting.empty()) continue;
    const Quaternion axes = orientation(r);
    const std::vector<Piece> mine = world_pieces(parting, now, axes);
    pieces.insert(pieces.end(), mine.begin(), mine.end());
    leaving.insert(leaving.end(), parting.begin(), parting.end());
    take_out(r);
    if (!staying.empty()) launch(r, staying, now, axes, world_pieces(staying, now, axes));
  }
  if (leaving.empty())
    throw EngineError(fmt::format("the split at t = {} s finds no particle in its region", event.time));
  launch(child, leaving, now, {}, pieces);
  rows_.push_back(child);
}

}  // namespace tripoint::bullet
