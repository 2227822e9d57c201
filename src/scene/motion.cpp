// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/motion.hpp"

namespace tripoint {
namespace {

/// Rotation vector [rad] that takes a to b by the shorter way.
Vec3 rotation_between(const Quaternion& a, const Quaternion& b) {
  Quaternion d = b * conjugate(a);  // world frame: b = d a
  if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
  const Vec3 v{d.x, d.y, d.z};
  const double sine = norm(v);
  if (sine < 1e-300) return {};
  return (2.0 * std::atan2(sine, d.w) / sine) * v;
}

}  // namespace

PrescribedState prescribed_state(const std::vector<Keyframe>& frames, const Vec3& centre,
                                 const Vec3& velocity, const Vec3& angular_velocity, double time) {
  if (frames.empty())
    return {centre + time * velocity, velocity, angular_velocity,
            from_rotation_vector(time * angular_velocity)};
  if (time < frames.front().time) return {frames.front().position, {}, {}, frames.front().rotation};
  if (time > frames.back().time || frames.size() == 1)
    return {frames.back().position, {}, {}, frames.back().rotation};
  // A keyframe's own time belongs to the piece that begins there, the last one's to the piece that ends
  // there.
  auto next = std::upper_bound(frames.begin(), frames.end(), time,
                               [](double t, const Keyframe& k) { return t < k.time; });
  if (next == frames.end()) --next;
  const auto& a = *(next - 1);
  const auto& b = *next;
  const double length = b.time - a.time, s = (time - a.time) / length;
  const Vec3 turn = rotation_between(a.rotation, b.rotation);
  return {a.position + s * (b.position - a.position), (b.position - a.position) / length, turn / length,
          normalised(from_rotation_vector(s * turn) * a.rotation)};
}

}  // namespace tripoint
