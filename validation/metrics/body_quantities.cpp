// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

bool alive(const BodyState& b) { return finite(b.position); }
bool whole(const BodyState& b) {
  const auto& q = b.orientation;
  return finite(b.position) && finite(b.velocity) && finite(b.angular_velocity) &&
         std::isfinite(q.w + q.x + q.y + q.z);
}

/// One sample for each body that is alive, or for the metric's body alone. A body that only one side has is
/// an error, not a gap.
template <class F>
FrameError over_bodies(const FramePair& f, F difference) {
  if (f.truth.bodies.empty()) return problem("the reference does not know the bodies");
  const long only = body_row(f.in);
  if (only < 0 && !f.in.choice.body.empty())
    return problem("body `" + f.in.choice.body + "` is liquid and has no row");
  FrameError out;
  const std::size_t rows = std::max(f.now.bodies.size(), f.truth.bodies.size());
  for (std::size_t b = 0; b < rows; ++b) {
    if (only >= 0 && static_cast<long>(b) != only) continue;
    const bool run = b < f.now.bodies.size() && alive(f.now.bodies[b]),
               truth = b < f.truth.bodies.size() && alive(f.truth.bodies[b]);
    if (!run && !truth && only < 0) continue;
    if (run != truth || !run)
      return problem("body row " + std::to_string(b) +
                     (run ? " should not exist" : " is missing or not finite") +
                     " at t = " + std::to_string(f.now.time) + " s");
    if (!whole(f.now.bodies[b])) return problem("body row " + std::to_string(b) + " is not finite");
    out.add(difference(f.now.bodies[b], f.truth.bodies[b]), 1.0, static_cast<long>(b));
  }
  return out;
}

/// The body's row of a frame; nullptr where it is not there.
const BodyState* row_of(const FramePair& f) {
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size()) return nullptr;
  const auto& b = f.now.bodies[static_cast<std::size_t>(row)];
  return whole(b) ? &b : nullptr;
}

/// A vector of the named body against a number that the case states: its component along the stated axis,
/// else its length.
FrameError stated_vector(const FramePair& f, Vec3 BodyState::*what, const char* name) {
  const auto axis = f.in.reference.measuring().axis;
  if (!truth_of(f.in, name, f.now.time))
    return problem(std::string("the reference does not know the bodies: name one, and state its ") + name +
                   ": reference = {function = \"stated\", args = {value = ...}}, with an axis for the "
                   "component along it");
  if (f.in.choice.body.empty())
    return problem(std::string("a stated ") + name + " is that of one solid body: name it");
  const auto* body = row_of(f);
  if (!body) return problem("the trajectory does not have the body");
  if (what == &BodyState::position && !axis)
    return problem("a stated position needs its axis: args = {axis = \"x\", value = ...}");
  if (!finite(body->*what)) return problem(std::string("the engine shows no ") + name + " on the body");
  return against_truth(f, name, axis ? (body->*what)[*axis] : norm(body->*what));
}

/// A vector of bodies against those of the reference, else against the number that the case states.
Quantity vector_of_bodies(const char* name, const char* unit, const char* meaning, Vec3 BodyState::*what) {
  return {{name, unit, meaning}, [=](const FramePair& f) {
            if (f.truth.bodies.empty() || swings(f.in.choice.norm)) return stated_vector(f, what, name);
            return over_bodies(f, [&](const BodyState& a, const BodyState& b) {
              return norm(what == &BodyState::position ? displacement(f.in.job.scene, a.position, b.position)
                                                       : a.*what - b.*what);
            });
          }};
}

/// Against the orientation of the reference, else the angle turned since the start against the number that
/// the case states.
FrameError orientation(const FramePair& f) {
  if (!f.truth.bodies.empty())
    return over_bodies(
        f, [](const auto& a, const auto& b) { return angle_between(a.orientation, b.orientation); });
  if (f.in.choice.body.empty() || !truth_of(f.in, "orientation", f.now.time))
    return problem("the reference does not know the bodies");
  const auto* body = row_of(f);
  return body ? against_truth(f, "orientation", angle_between(body->orientation, {}))
              : problem("the trajectory does not have the body");
}

double alive_count(const Snapshot& s) {
  return static_cast<double>(std::count_if(s.bodies.begin(), s.bodies.end(), alive));
}

FrameError body_count(const FramePair& f) {
  if (f.truth.bodies.empty()) return against_truth(f, "body_count", alive_count(f.now));
  return single(alive_count(f.now) - alive_count(f.truth));
}

/// Largest relative change of the distances to four members far apart, which fix the shape of all; pairs in
/// one body now and then only.
double stretch(const FramePair& f, const std::vector<std::size_t>& members) {
  const auto& start = f.in.initial.position;
  std::vector<std::size_t> anchors{members.front()};
  while (anchors.size() < std::min<std::size_t>(4, members.size())) {
    const auto reach = [&](std::size_t i) {
      double least = 1e300;
      for (const auto a : anchors) least = std::min(least, norm(start[i] - start[a]));
      return least;
    };
    anchors.push_back(*std::max_element(members.begin(), members.end(),
                                        [&](auto i, auto j) { return reach(i) < reach(j); }));
  }
  double worst = 0.0;
  for (const auto a : anchors)
    for (const auto i : members) {
      if (i == a || f.now.body[i] != f.now.body[a]) continue;
      const double before = norm(start[i] - start[a]);
      const double change =
          norm(displacement(f.in.job.scene, f.now.position[i], f.now.position[a])) / before - 1.0;
      if (!std::isfinite(change)) return not_a_number;
      worst = std::max(worst, std::abs(change));
    }
  return worst;
}

FrameError shape(const FramePair& f) {
  if (f.now.position.size() < f.in.initial.size() || f.now.body.size() != f.now.position.size())
    return problem("the trajectory has no positions and bodies of all particles");
  FrameError out;
  for (std::size_t b = 0; b < f.in.job.bodies.size(); ++b) {
    const auto& body = f.in.job.bodies[b];
    const bool meant = f.in.choice.body.empty()
                           ? body.phase == Phase::rigid
                           : body.phase != Phase::liquid && f.in.choice.body == body.name;
    if (!meant) continue;
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < f.in.initial.size(); ++i)
      if (f.in.initial.source[i] == static_cast<int>(b)) members.push_back(i);
    if (members.size() > 1) out.add(stretch(f, members), 1.0, body.index);
  }
  return out.error.empty() ? problem("there is no rigid body of two particles or more") : out;
}

}  // namespace

const std::vector<Quantity>& body_quantities() {
  static const std::vector<Quantity> list{
      vector_of_bodies("position", "m", "", &BodyState::position),
      vector_of_bodies("velocity", "m/s", "", &BodyState::velocity),
      {{"orientation", "rad",
        "angle between the orientations of bodies, 0 to pi; of a named body the angle since the start minus "
        "the stated value"},
       orientation},
      vector_of_bodies("angular_velocity", "rad/s",
                       "difference of angular velocities of bodies, world frame; of a named body its size "
                       "(component) minus the stated value",
                       &BodyState::angular_velocity),
      vector_of_bodies("force", "N",
                       "difference of the forces on bodies from all others; of a named body its size "
                       "(component) minus the stated value",
                       &BodyState::force),
      vector_of_bodies("torque", "N m",
                       "difference of the torques on bodies from all others; of a named body as for `force`",
                       &BodyState::torque),
      {{"body_count", "1", "difference in the number of solid bodies alive, or from the stated value"},
       body_count},
      {{"shape", "1",
        "largest relative change of distances inside a rigid body, or an elastic one that is named, since "
        "the start; needs no "
        "reference"},
       shape}};
  return list;
}

}  // namespace tripoint
