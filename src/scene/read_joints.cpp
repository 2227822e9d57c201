// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/joint_checks.hpp"
#include "scene/joints.hpp"
#include "scene/name_checks.hpp"
#include "scene/readers.hpp"
#include "scene/scene_keys.hpp"
#include "scene/scene_records.hpp"
#include "scene/value_reader.hpp"

/// [[joint]]: its keys, and what its kind and its bodies allow.
namespace tripoint {
namespace {

using JointKind = Joint::Kind;

constexpr double right_angle = 1e-9;  ///< cosine up to which two axes are at right angles [1]

std::string kind_word(JointKind kind) {
  return split_words(key_row("joint", "kind").words).at(static_cast<std::size_t>(kind));
}

/// A key that the kind needs, or does not read.
void expect_key(const TableReader& in, const char* key, bool given, bool read, JointKind kind) {
  if (given && !read)
    in.refuse(key, fmt::format("a joint of kind {} does not read it: remove it", kind_word(kind)));
  if (!given && read)
    in.refuse("", fmt::format("a joint of kind {} needs the key `{}`", kind_word(kind), key));
}

void unit_axis(const TableReader& in, const char* key, std::optional<Vec3>& axis) {
  if (!axis) return;
  if (!(norm(*axis) > 0.0)) in.refuse(key, "the axis has no length: write a direction, as [0, 0, 1]");
  *axis = *axis / norm(*axis);
}

void refuse_forces_without_coordinate(const TableReader& in, const Joint& j) {
  if (j.has_coordinate()) return;
  const std::pair<const char*, bool> given[] = {{"limits", j.limits.has_value()},
                                                {"friction", j.friction > 0.0},
                                                {"damping", j.damping > 0.0},
                                                {"spring", j.spring.has_value()},
                                                {"motor", j.motor.has_value()}};
  for (const auto& [key, there] : given)
    if (there)
      in.refuse(key, "only a hinge and a slider have one angle or way that it acts along: remove it");
}

void check_limits_and_motor(const TableReader& in, const Joint& j) {
  if (j.limits && !((*j.limits)[0] <= 0.0 && 0.0 <= (*j.limits)[1] && (*j.limits)[0] < (*j.limits)[1]))
    in.refuse("limits", "the coordinate is 0 at the start: write [low, high] with low <= 0 <= high");
  if (j.motor && j.motor->effort.has_value() == j.motor->speed.has_value())
    in.refuse("motor", "write motor = { effort = ... } or motor = { speed = ... }");
  if (j.motor && j.motor->speed && j.limits)
    in.refuse("limits", "the motor keeps its speed, also beyond them: write motor = { effort = ... }");
  if (j.restitution > 0.0 && !j.limits) in.refuse("restitution", "it is that of limits, and there are none");
}

}  // namespace

Joint read_joint(const TomlNode& node, Reading& reading) {
  TableReader in(node, "joint", "joint." + entry_name(node, 1), reading.decisions, scene_keys());
  Joint j;
  j.place = node.place;
  RecordReader(in, j, reading).all();
  plain_name(in, "name", j.name);
  if (j.bodies.size() != 2) in.refuse("bodies", "write two bodies, or a body and \"world\"");
  const bool universal = j.kind == JointKind::universal, distance = j.kind == JointKind::distance;
  expect_key(in, "axis", j.axis.has_value(), universal || j.has_coordinate(), j.kind);
  expect_key(in, "other_axis", j.other_axis.has_value(), universal, j.kind);
  expect_key(in, "other_place", j.other_point.has_value(), distance, j.kind);
  unit_axis(in, "axis", j.axis);
  unit_axis(in, "other_axis", j.other_axis);
  if (universal && std::abs(dot(*j.axis, *j.other_axis)) > right_angle)
    in.refuse("other_axis", "the axes of a universal joint are at right angles");
  if (distance && norm(*j.other_point - j.point) == 0.0)
    in.refuse("other_place", "the points coincide: write a joint of kind ball");
  refuse_forces_without_coordinate(in, j);
  check_limits_and_motor(in, j);
  return j;
}

JointChecks::JointChecks(const Scene& scene, const Reading& reading) : NameChecks(reading), scene_(scene) {}

void JointChecks::check() const {
  unique(scene_.joints, "joint");
  for (const Joint& j : scene_.joints) {
    const std::string path = fmt::format("joint.{}.bodies", j.name);
    const auto refuse = [&](const std::string& why) { throw InputError(place(path, j.place), why); };
    bool moves = false;
    for (const auto& name : j.bodies) {
      if (name == "world") continue;
      known_body(scene_, name, path, j.place);
      const Body& b = scene_.body(name);
      if (b.phase != Phase::rigid)
        refuse(fmt::format("\"{}\" is {}: a joint holds rigid bodies", name, to_string(b.phase)));
      if (scene_.material(b.material).t_melt)
        refuse(fmt::format("the material of \"{}\" melts: remove its t_melt, or the joint", name));
      if (b.motion == Motion::prescribed)
        refuse(fmt::format("\"{}\" is prescribed: a joint holds free bodies, to each other or to fixed ones",
                           name));
      moves = moves || b.motion == Motion::free;
    }
    if (!moves) refuse("neither body is free: a joint of these holds nothing");
    if (std::ranges::any_of(scene_.events, [](const Event& e) { return e.kind != Event::Kind::heat; }))
      refuse(
          "a joint holds bodies that stay what they are: remove the events that merge, split, hold or move "
          "any");
    if (scene_.is_planar() || std::ranges::any_of(scene_.periodic, [](bool p) { return p; }))
      refuse("joints are simulated in three dimensions, without periodic directions");
  }
}

bool has_joint(const Scene& scene, const std::string& a, const std::string& b) {
  return std::ranges::any_of(scene.joints, [&](const Joint& j) {
    return (j.bodies[0] == a && j.bodies[1] == b) || (j.bodies[0] == b && j.bodies[1] == a);
  });
}

}  // namespace tripoint
