// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "validation/metrics/members.hpp"
#include "validation/metrics/near_pairs.hpp"

namespace tripoint {
namespace {

bool shows_solids(const Snapshot& s, std::size_t n) {
  return s.position.size() >= n && n > 0 && s.phase.size() == s.position.size() &&
         s.body.size() == s.position.size();
}
std::string no_solids(const FramePair& f) {
  return shows_solids(f.now, f.in.initial.size())
             ? ""
             : "the trajectory has no positions, phases and bodies of all particles";
}

// --- depth of one body in another

/// The particles of another body within two spacings, seen from one particle.
struct Facing {
  Vec3 inward;              // sum of the unit vectors to them
  std::vector<Vec3> place;  // from the particle [m]
};

/// Before the other body's outer layer: 1 - least distance / spacing, 0 at one spacing. Past it: 1 + how far
/// past, which no distance shows. The outer layer is the highest along the line out of the other body. Within
/// 0.8 spacings of that line a lattice always has a particle.
double depth(const Facing& other, double dx) {
  const double length = norm(other.inward);
  // Deep inside, no way out to be seen: two spacings and the one before the layer
  if (length == 0.0) return 3.0;
  const Vec3 out = (-1.0 / length) * other.inward;
  double highest = -2.0 * dx, nearest = 2.0 * dx;
  for (const auto& d : other.place) {
    const double height = dot(d, out);
    if (norm(d - height * out) <= 0.8 * dx) highest = std::max(highest, height);
    nearest = std::min(nearest, norm(d));
  }
  return highest > 0.0 ? 1.0 + highest / dx : 1.0 - nearest / dx;
}

double deepest(const MetricInput& in, const Snapshot& s) {
  const double dx = in.job.scene.spacing;
  std::vector<std::size_t> solids;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (is_alive(s, i) && s.phase[i] != 0 && s.body[i] >= 0) solids.push_back(i);
  std::map<std::pair<std::size_t, int>, Facing> facing;
  for_near_pairs(in.job.scene, s.position, solids, 2.0 * dx,
                 [&](std::size_t i, std::size_t j, const Vec3& d) {
                   if (s.body[i] == s.body[j] || (!takes(in, i) && !takes(in, j)) ||
                       (is_driven(in, i) && is_driven(in, j)))
                     return;
                   auto& other = facing[{i, s.body[j]}];
                   other.place.push_back(d);
                   if (norm(d) > 0.0) other.inward += (1.0 / norm(d)) * d;
                 });
  double most = 0.0;
  for (const auto& [who, other] : facing) most = std::max(most, depth(other, dx));
  return most;
}

/// From the stated value, else from another run's overlap, else from none.
FrameError overlap(const FramePair& f) {
  if (auto why = no_solids(f); !why.empty()) return problem(why);
  const auto stated = f.in.reference.number("value");
  const double truth = stated                                       ? *stated
                       : shows_solids(f.truth, f.in.initial.size()) ? deepest(f.in, f.truth)
                                                                    : 0.0;
  return single(deepest(f.in, f.now) - truth);
}

// --- two bodies

std::pair<RigidBody, RigidBody> both(const FramePair& f) {
  return {motion_of(f.in, f.now, sampled(f.in, job_body(f.in))),
          motion_of(f.in, f.now, sampled(f.in, other_body(f.in)))};
}

FrameError separation(const FramePair& f) {
  if (auto why = no_solids(f); !why.empty()) return problem(why);
  const auto [a, b] = both(f);
  return against_truth(f, "separation", norm(displacement(f.in.job.scene, b.centre, a.centre)));
}

FrameError relative_motion(const FramePair& f) {
  if (auto why = no_solids(f); !why.empty()) return problem(why);
  const auto [a, b] = both(f);
  const Vec3 carried =
      a.velocity + cross(a.angular_velocity, displacement(f.in.job.scene, b.centre, a.centre));
  return single(norm(b.velocity - carried) - f.in.reference.number("value").value_or(0.0));
}

// --- objects

std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

FrameError object_count(const FramePair& f) {
  if (auto why = no_solids(f); !why.empty()) return problem(why);
  std::vector<std::size_t> parent(f.now.position.size()), members;
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const bool any_phase = f.in.reference.measuring().phase.has_value();
  for (std::size_t i = 0; i < parent.size(); ++i)
    if (is_alive(f.now, i) && takes(f.in, i) &&
        (any_phase ? of_stated_phase(f.in, f.now, i) : f.now.phase[i] != 0))
      members.push_back(i);
  const double reach = f.in.job.scene.merge_distance * f.in.job.scene.spacing;
  for_near_pairs(f.in.job.scene, f.now.position, members, reach,
                 [&](std::size_t i, std::size_t j, const Vec3&) {
                   const auto a = root(parent, i), b = root(parent, j);
                   parent[std::max(a, b)] = std::min(a, b);
                 });
  const auto count =
      std::count_if(members.begin(), members.end(), [&](std::size_t i) { return root(parent, i) == i; });
  return against_truth(f, "object_count", static_cast<double>(count));
}

}  // namespace

const std::vector<Quantity>& contact_quantities() {
  static const std::vector<Quantity> list{
      {{"overlap", "spacings",
        "largest depth of a solid particle in another body: 1 - least "
        "distance / spacing, and 1 to 3 past its outer layer. Pairs "
        "of walls do not count"},
       overlap},
      {{"separation", "m",
        "distance of the centres of the metric's and the other body, of "
        "their particles as sampled, minus the stated value"},
       separation},
      {{"relative_motion", "m/s",
        "speed of the other body's centre in the frame of the metric's body: "
        "|v_b - v_a - w_a x (r_b - r_a)|"},
       relative_motion},
      {{"object_count", "1",
        "clusters of solid particles (of the stated phase) nearer than "
        "merge_distance, minus the stated value; touching bodies "
        "count as one"},
       object_count}};
  return list;
}

}  // namespace tripoint
