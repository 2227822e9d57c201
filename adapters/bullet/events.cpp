// SPDX-License-Identifier: BSD-3-Clause
// Merge and split: bodies are taken out of Bullet's world and others put in, so that P and L hold to round-off.
// (A btFixedConstraint between two bodies would lose angular momentum.)
#include <fmt/format.h>

#include <algorithm>

#include "adapters/bullet/bullet_engine.hpp"
#include "scene/geometry.hpp"
#include "scene/read_case.hpp"

namespace tripoint::bullet {
namespace {

/// w = I^-1 L in principal axes; no spin about an axis without a moment. [rad/s], world frame
Vec3 spin_of(const MassProperties& p, const Vec3& angular_momentum) {
  Vec3 w = rotate_back(p.principal_axes, angular_momentum);
  for (std::size_t k = 0; k < 3; ++k) w[k] = p.principal_inertia[k] > 0.0 ? w[k] / p.principal_inertia[k] : 0.0;
  return rotate(p.principal_axes, w);
}

/// The same piece as seen from another frame.
Piece moved(const Piece& piece, const RigidMotion& from, const Vec3& centre, const Quaternion& principal) {
  const Vec3 at = from.centre + rotate(from.orientation, piece.centre);
  return {piece.sphere, rotate_back(principal, at - centre), conjugate(principal) * from.orientation * piece.rotation, piece.half_extents};
}

}  // namespace

void BulletEngine::apply(const Event& event) {
  if (event.kind == Event::Kind::merge)
    merge(event);
  else
    split(event);
}

BulletEngine::Row& BulletEngine::row(const std::string& name) {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == name && r.handle >= 0; });
  if (found == rows_.end()) throw EngineError(fmt::format("no body '{}' at t = {} s", name, time_));
  return *found;
}

std::vector<Vec3> BulletEngine::positions(const Row& r) const {
  const RigidMotion m = world_->motion(r.handle);
  std::vector<Vec3> at;
  for (const Vec3& arm : r.arms) at.push_back(m.centre + rotate(m.orientation, arm));
  return at;
}

std::vector<double> BulletEngine::masses(const std::vector<int>& members) const {
  std::vector<double> m;
  for (const int i : members) m.push_back(state_.mass[static_cast<std::size_t>(i)]);
  return m;
}

Quaternion BulletEngine::orientation(const Row& r) const { return world_->motion(r.handle).orientation * conjugate(r.frame); }

/// bodies[0] absorbs the rest and keeps its orientation: v = P/M, w = I^-1 L about the new centre.
void BulletEngine::merge(const Event& event) {
  Row& keeper = row(event.bodies.front());
  const Quaternion axes = orientation(keeper);
  std::vector<int> members;
  std::vector<Vec3> at;
  Vec3 momentum, angular_momentum;  // about the origin
  for (const std::string& name : event.bodies) {
    const Row& r = row(name);
    const RigidMotion m = world_->motion(r.handle);
    const Vec3 w = rotate_back(m.orientation, m.angular_velocity), inertia = r.properties.principal_inertia;
    momentum += r.properties.mass * m.velocity;
    angular_momentum += r.properties.mass * cross(m.centre, m.velocity) + rotate(m.orientation, Vec3{inertia.x * w.x, inertia.y * w.y, inertia.z * w.z});
    const std::vector<Vec3> here = positions(r);
    members.insert(members.end(), r.members.begin(), r.members.end());
    at.insert(at.end(), here.begin(), here.end());
  }
  const MassProperties whole = mass_properties(at, masses(members));
  std::vector<Piece> pieces;
  for (const std::string& name : event.bodies) {
    Row& r = row(name);
    const RigidMotion m = world_->motion(r.handle);
    for (const Piece& piece : r.pieces) pieces.push_back(moved(piece, m, whole.centre, whole.principal_axes));
    world_->remove(r.handle);
    r.handle = -1;
  }
  keeper.properties = whole;
  keeper.frame = conjugate(axes) * whole.principal_axes;
  keeper.members = members;
  keeper.pieces = pieces;
  set_arms(keeper, at, whole.centre, whole.principal_axes);
  const Vec3 spin_momentum = angular_momentum - cross(whole.centre, momentum);
  enter(keeper, {whole.centre, whole.principal_axes, momentum / whole.mass, spin_of(whole, spin_momentum)});
}

std::vector<int> BulletEngine::members_in(const Row& r, const Event& event) const {
  const std::vector<Vec3> at = positions(r);
  const auto inside = inside_of(*event.region, job_.resolution.spacing);
  std::vector<int> chosen;
  for (std::size_t k = 0; k < at.size(); ++k)
    if (inside(at[k])) chosen.push_back(r.members[k]);
  return chosen;
}

/// The body that is named, or the first with a member in the region.
BulletEngine::Row& BulletEngine::splitting_row(const Event& event) {
  if (!event.region) throw EngineError(fmt::format("the split at t = {} s has no region", event.time));
  if (!event.bodies.empty()) return row(event.bodies.front());
  for (Row& r : rows_)
    if (r.handle >= 0 && r.motion == Motion::free && !members_in(r, event).empty()) return r;
  throw EngineError(fmt::format("the split at t = {} s finds no particle in its region", event.time));
}

/// Members in the region become a new row; both parts move on as the particles did: v + w x r, the same w.
void BulletEngine::split(const Event& event) {
  Row& parent = splitting_row(event);
  const std::vector<int> leaving = members_in(parent, event);
  if (leaving.empty() || leaving.size() == parent.members.size())
    throw EngineError(fmt::format("the split at t = {} s takes {} of the {} particles of {}", event.time, leaving.size(), parent.members.size(), parent.name));
  std::vector<int> staying;
  for (const int i : parent.members)
    if (std::find(leaving.begin(), leaving.end(), i) == leaving.end()) staying.push_back(i);
  const RigidMotion whole = world_->motion(parent.handle);
  const Quaternion axes = orientation(parent);
  Row child = parent;
  child.name = event.name;
  world_->remove(parent.handle);
  take_part(parent, staying, whole, axes);
  take_part(child, leaving, whole, {});
  rows_.push_back(child);
}

/// Shrinks a row to the given members of the body that moved as `whole`; its lattice keeps the body's axes.
/// @param body_axes orientation that the row goes on with; (1,0,0,0) for a newborn
void BulletEngine::take_part(Row& r, const std::vector<int>& members, const RigidMotion& whole, const Quaternion& body_axes) {
  const Quaternion lattice = whole.orientation * conjugate(r.frame);
  std::vector<Vec3> at;
  for (std::size_t k = 0; k < r.members.size(); ++k)
    if (std::find(members.begin(), members.end(), r.members[k]) != members.end())
      at.push_back(whole.centre + rotate(whole.orientation, r.arms[k]));
  r.members = members;
  r.properties = mass_properties(at, masses(members));
  r.frame = conjugate(body_axes) * r.properties.principal_axes;
  set_arms(r, at, r.properties.centre, r.properties.principal_axes);
  r.pieces = particle_pieces(r, conjugate(body_axes) * lattice);
  const Vec3 v = whole.velocity + cross(whole.angular_velocity, r.properties.centre - whole.centre);
  enter(r, {r.properties.centre, r.properties.principal_axes, v, whole.angular_velocity});
}

}  // namespace tripoint::bullet
