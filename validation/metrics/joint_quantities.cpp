// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

using JointKind = Joint::Kind;

/// One side of a joint in a frame: where its point is, and how its body has turned since the start.
struct JointSide {
  Vec3 point;
  Quaternion turn;
};

/// @return no side where the frame does not have the body
std::optional<JointSide> side_of(const Job& job, const Snapshot& s, const std::string& body,
                                 const Vec3& point) {
  if (body == "world") return JointSide{point, {}};
  const auto found = std::ranges::find(job.bodies, body, &JobBody::name);
  if (found == job.bodies.end() || static_cast<std::size_t>(found->index) >= s.bodies.size()) return {};
  const BodyState& b = s.bodies[static_cast<std::size_t>(found->index)];
  if (!finite(b.position) || !std::isfinite(norm(b.orientation))) return {};
  const Quaternion turn = normalised(b.orientation);
  return JointSide{b.position + rotate(turn, point - found->properties.centre), turn};
}

struct JointSides {
  JointSide a, b;
};
std::optional<JointSides> sides_of(const Job& job, const Snapshot& s, const Joint& j) {
  const auto a = side_of(job, s, j.bodies[0], j.point),
             b = side_of(job, s, j.bodies[1], j.other_point.value_or(j.point));
  return a && b ? std::optional(JointSides{*a, *b}) : std::nullopt;
}

/// Angle between two directions, 0 to pi [rad]; exact near 0.
double angle_of(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// Distance of the points of a joint; across the axis of a slider, beyond the length of a distance [m].
double gap_of(const Joint& j, const JointSides& s) {
  const Vec3 way = s.a.point - s.b.point;
  if (j.kind == JointKind::distance) return norm(way) - norm(j.point - *j.other_point);
  if (j.kind != JointKind::slider) return norm(way);
  const Vec3 axis = rotate(s.b.turn, *j.axis);
  return norm(way - dot(way, axis) * axis);
}

/// Angle by which axes, or orientations, are off what the joint holds [rad]; none for a ball and a distance.
std::optional<double> misalignment_of(const Joint& j, const JointSides& s) {
  switch (j.kind) {
    case JointKind::hinge:
      return angle_of(rotate(s.a.turn, *j.axis), rotate(s.b.turn, *j.axis));
    case JointKind::universal:
      return angle_of(rotate(s.a.turn, *j.axis), rotate(s.b.turn, *j.other_axis)) - 0.5 * std::numbers::pi;
    case JointKind::slider:
    case JointKind::fixed:
      return angle_between(s.a.turn, s.b.turn);
    case JointKind::ball:
    case JointKind::distance:
      break;
  }
  return {};
}

/// Angle or way of the first body against the second, 0 at the start [rad], -pi to pi, or [m].
double coordinate_of(const Joint& j, const JointSides& s) {
  const Vec3 axis = rotate(s.b.turn, *j.axis);
  if (j.kind == JointKind::slider) return dot(s.a.point - s.b.point, axis);
  const Quaternion relative = s.a.turn * conjugate(s.b.turn);
  return 2.0 * std::atan2(dot({relative.x, relative.y, relative.z}, axis), relative.w);
}

/// One sample a joint of the metric's body, or of all; value(joint, sides) may have none.
template <class Value>
FrameError over_joints(const FramePair& f, const char* which, Value value) {
  FrameError out;
  const auto& joints = f.in.job.scene.joints;
  for (std::size_t n = 0; n < joints.size(); ++n) {
    const Joint& j = joints[n];
    if (!f.in.choice.body.empty() && std::ranges::find(j.bodies, f.in.choice.body) == j.bodies.end())
      continue;
    const auto sides = sides_of(f.in.job, f.now, j);
    if (!sides) return problem("the trajectory does not have the bodies of joint `" + j.name + "`");
    const std::optional<double> one = value(j, *sides);
    if (one) out.add(*one, 1.0, static_cast<long>(n));
  }
  return out.error.empty() ? problem(std::string("there is no joint ") + which) : out;
}

FrameError joint_gap(const FramePair& f) {
  return over_joints(f, "of the body",
                     [](const Joint& j, const JointSides& s) { return std::optional(gap_of(j, s)); });
}

FrameError joint_misalignment(const FramePair& f) {
  return over_joints(f, "that holds an angle", misalignment_of);
}

FrameError joint_coordinate(const FramePair& f) {
  if (f.truth.bodies.empty()) return problem("the reference does not know the bodies");
  return over_joints(f, "of kind hinge or slider",
                     [&](const Joint& j, const JointSides& s) -> std::optional<double> {
                       const auto truth = sides_of(f.in.job, f.truth, j);
                       if (!j.has_coordinate() || !truth) return {};
                       const double off = coordinate_of(j, s) - coordinate_of(j, *truth);
                       return j.kind == JointKind::slider ? off : std::remainder(off, 2.0 * std::numbers::pi);
                     });
}

}  // namespace

const std::vector<Quantity>& joint_quantities() {
  static const std::vector<Quantity> list{
      {{"joint_gap", "m",
        "distance of the two points of a joint; across the axis of a slider, beyond the length of a "
        "distance"},
       joint_gap},
      {{"joint_misalignment", "rad",
        "angle by which the two bodies are turned off what a hinge, slider, fixed or universal joint holds"},
       joint_misalignment},
      {{"joint_coordinate", "rad or m",
        "angle of a hinge or way of a slider, less that of the reference, within half a turn"},
       joint_coordinate}};
  return list;
}

}  // namespace tripoint
