// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/prescribed.hpp"

namespace tripoint {
namespace {

BodyState at_rest(const Keyframe& key) {
  BodyState state;
  state.position = key.position;
  state.orientation = normalised(key.rotation);
  return state;
}

BodyState between(const Keyframe& a, const Keyframe& b, double time) {
  const double span = b.time - a.time, s = (time - a.time) / span;
  const Quaternion from = normalised(a.rotation), to = normalised(b.rotation);
  const Vec3 turn = rotation_vector(to * conjugate(from));  // world frame
  BodyState state;
  state.position = a.position + s * (b.position - a.position);
  state.velocity = (b.position - a.position) / span;
  state.orientation = from_rotation_vector(s * turn) * from;
  state.angular_velocity = turn / span;
  return state;
}

}  // namespace

BodyState prescribed_motion(const JobBody& body, double time) {
  const auto& keys = body.keyframes;
  BodyState state;
  if (keys.empty()) {
    const bool moves = body.motion == Motion::prescribed;
    state.velocity = moves ? body.velocity : Vec3{};
    state.angular_velocity = moves ? body.angular_velocity : Vec3{};
    state.position = body.properties.centre + time * state.velocity;
    state.orientation = from_rotation_vector(time * state.angular_velocity);
  } else if (time < keys.front().time || time >= keys.back().time) {
    state = at_rest(time < keys.front().time ? keys.front() : keys.back());
  } else {
    std::size_t n = 1;
    while (keys[n].time <= time) ++n;
    state = between(keys[n - 1], keys[n], time);
  }
  state.mass = body.properties.mass;
  return state;
}

}  // namespace tripoint
