// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

bool is_led(const JobBody* body) {
  return body && body->motion == Motion::prescribed && !body->keyframes.empty();
}

/// Else ids are swapped, units wrong, or the time axis shifted.
std::string starts_elsewhere(const Audited& run, const Snapshot& first) {
  const double spacing = run.job.scene.spacing, tolerance = 1e-6 * (spacing > 0.0 ? spacing : 1.0);
  for (std::size_t i = 0; i < std::min(first.position.size(), run.initial.size()); ++i) {
    if (is_led(body_of(run, i)) || dead(first, i)) continue;
    const double rounding = run.is_single() ? 1.2e-7 * norm(run.initial.position[i]) : 0.0;
    if (!(norm(displacement(run.job.scene, first.position[i], run.initial.position[i])) <=
          tolerance + rounding))
      return "the first frame is not the job's start: particle " + std::to_string(i) +
             " is elsewhere (other units, permuted ids or a shifted time?)";
  }
  return {};
}

/// Events at the start may change velocities before the first frame is written.
bool changes_at_once(const Audited& run, const Snapshot& first) {
  const auto& events = run.job.scene.events;
  return std::any_of(events.begin(), events.end(), [&](const Event& e) { return e.time <= first.time; });
}

std::string starts_at_another_speed(const Audited& run, const Snapshot& first) {
  double fastest = 0.0;
  for (const Vec3& v : run.initial.velocity) fastest = std::max(fastest, norm(v));
  for (std::size_t i = 0; i < std::min(first.velocity.size(), run.initial.velocity.size()); ++i) {
    const auto* body = body_of(run, i);
    if (!body || body->motion != Motion::free || dead(first, i)) continue;
    if (!(norm(first.velocity[i] - run.initial.velocity[i]) <= 1e-5 * fastest))
      return "the first frame is not the job's start: particle " + std::to_string(i) +
             " has another velocity";
  }
  return {};
}

std::string body_starts_otherwise(const Audited& run, const Snapshot& first) {
  for (const auto& b : run.job.bodies) {
    if (b.index < 0 || static_cast<std::size_t>(b.index) >= first.bodies.size() || b.phase != Phase::rigid ||
        b.motion != Motion::free)
      continue;
    const BodyState& now = first.bodies[static_cast<std::size_t>(b.index)];
    const std::string start = "the first frame is not the job's start: `" + b.name + "` has another ";
    if (!is_there(now) || !finite(now.angular_velocity)) continue;  // its turning is not stated
    if (!(angle_between(now.orientation, {}) <= (run.is_single() ? 1e-3 : 1e-6)))
      return start + "orientation than (1, 0, 0, 0)";
    const double rounding = 1e-5 * (norm(b.angular_velocity) + norm(b.velocity) / run.job.scene.spacing);
    if (!(norm(now.angular_velocity - b.angular_velocity) <= rounding)) return start + "angular velocity";
  }
  return {};
}

}  // namespace

std::string another_start(const Audited& run) {
  const Snapshot& first = *run.frames.front();
  if (auto why = starts_elsewhere(run, first); !why.empty() || changes_at_once(run, first)) return why;
  if (auto why = starts_at_another_speed(run, first); !why.empty()) return why;
  return body_starts_otherwise(run, first);
}

}  // namespace tripoint
