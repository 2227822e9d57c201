// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

constexpr double without_bound = std::numeric_limits<double>::infinity();

void take(Box& box, const Vec3& x) {
  if (box.empty) box.low = box.high = x;
  box.empty = false;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], x[k]);
    box.high[k] = std::max(box.high[k], x[k]);
  }
}

Box united(Box box, const Box& other) {
  if (other.empty) return box;
  take(box, other.low);
  take(box, other.high);
  return box;
}

bool meet(const Box& a, const Box& b, double reach) {
  if (a.empty || b.empty) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] - reach > b.high[k] || b.low[k] - reach > a.high[k]) return false;
  return true;
}

bool meet(const Box& box, const Shape& half_space, double reach) {
  if (box.empty) return false;
  const Vec3 n = (1.0 / norm(half_space.normal)) * half_space.normal;
  Vec3 lowest = box.low;
  for (std::size_t k = 0; k < 3; ++k) lowest[k] = n[k] > 0.0 ? box.low[k] : box.high[k];
  return dot(lowest - half_space.point, n) < reach;
}

/// Boxes of all bodies in one frame.
std::vector<Box> boxes_in(const Audited& run, const Snapshot& s) {
  std::vector<Box> boxes(run.job.bodies.size());
  for (std::size_t i = 0; i < std::min(s.position.size(), run.initial.source.size()); ++i)
    if (const auto source = static_cast<std::size_t>(run.initial.source[i]);
        source < boxes.size() && !dead(s, i))
      take(boxes[source], s.position[i]);
  return boxes;
}

Box swept(const Audited& run, std::size_t body, std::size_t interval) {
  if (run.boxes.empty())
    for (const auto* s : run.frames) run.boxes.push_back(boxes_in(run, *s));
  return united(run.boxes[interval][body], run.boxes[interval + 1][body]);
}

const BodyState* row_of(const JobBody& body, const Snapshot& s) {
  const bool has_row = body.index >= 0 && static_cast<std::size_t>(body.index) < s.bodies.size();
  return has_row ? &s.bodies[static_cast<std::size_t>(body.index)] : nullptr;
}

/// Largest speed of a body's matter beside a velocity, at one time [m/s].
double fastest_beside(const Audited& run, std::size_t other, const Snapshot& s, const Vec3& velocity) {
  double most = 0.0;
  if (const auto* row = row_of(run.job.bodies[other], s);
      row && run.job.bodies[other].phase == Phase::rigid) {
    const Box& box = run.boxes.front()[other];
    return norm(row->velocity - velocity) + norm(row->angular_velocity) * norm(box.high - box.low);
  }
  for (std::size_t i = 0; i < std::min(s.velocity.size(), run.initial.source.size()); ++i)
    if (static_cast<std::size_t>(run.initial.source[i]) == other && !dead(s, i))
      most = std::max(most, norm(s.velocity[i] - velocity));
  return most;
}

/// Bodies whose swept boxes come within three spacings of that of one body.
std::vector<std::size_t> near_bodies(const Audited& run, std::size_t body, std::size_t interval) {
  const auto& scene = run.job.scene;
  const bool unknown = scene.periodic[0] || scene.periodic[1] || scene.periodic[2] || !scene.inflows.empty();
  const Box own = swept(run, body, interval);
  const double reach = 3.0 * scene.spacing;
  std::vector<std::size_t> near;
  for (std::size_t b = 0; b < run.job.bodies.size(); ++b) {
    const bool is_plane = b < scene.bodies.size() && scene.bodies[b].shape.kind == Shape::Kind::half_space;
    const bool meets =
        meet(own, swept(run, b, interval), reach) || (is_plane && meet(own, scene.bodies[b].shape, reach));
    if (b != body && (unknown || meets)) near.push_back(b);
  }
  return near;
}

/// Largest speed of a rigid body in the frames of an interval and in those beside them, its turning included;
/// without bound where it has no row [m/s].
double speed_about(const Audited& run, std::size_t body, std::size_t interval) {
  const JobBody& b = run.job.bodies[body];
  const double length = norm(run.boxes.front()[body].high - run.boxes.front()[body].low);
  double most = 0.0;
  for (std::size_t n = interval > 0 ? interval - 1 : 0; n < std::min(interval + 3, run.frames.size()); ++n) {
    const auto* row = b.phase == Phase::rigid ? row_of(b, *run.frames[n]) : nullptr;
    if (!row || !is_there(*row)) return without_bound;
    const double speed = norm(row->velocity) + length * norm(row->angular_velocity);
    most = std::isfinite(speed) ? std::max(most, speed) : without_bound;
  }
  return most;
}

/// What rests among bodies that rest hides little: weight and support act in the same step, and what trembles
/// shows it in one of four frames.
double hidden_at_rest(const Audited& run, std::size_t body, const std::vector<std::size_t>& near,
                      std::size_t interval, double step) {
  constexpr double steps_of_gravity = 2.0, trembling = 10.0;
  double most = speed_about(run, body, interval);
  for (const std::size_t other : near) most = std::max(most, speed_about(run, other, interval));
  return steps_of_gravity * norm(run.job.scene.gravity) * step + trembling * most;
}

}  // namespace

bool is_tied(const Scene& scene, const std::string& body) {
  return std::ranges::any_of(
             scene.joints,
             [&](const Joint& j) { return std::ranges::find(j.bodies, body) != j.bodies.end(); }) ||
         std::ranges::any_of(scene.springs,
                             [&](const Spring& s) { return s.body == body || s.other == body; });
}

Contact contact_of(const Audited& run, std::size_t body, std::size_t interval) {
  const bool tied = is_tied(run.job.scene, run.job.bodies[body].name);
  if (run.job.bodies.size() < 2 && !tied) return {};
  const auto near = near_bodies(run, body, interval);
  if (near.empty() && !tied) return {};
  const Snapshot &a = *run.frames[interval], &b = *run.frames[interval + 1];
  const auto velocity = [&](const Snapshot& s) {
    const auto* row = row_of(run.job.bodies[body], s);
    return row ? row->velocity : Vec3{};
  };
  const double time = b.time - a.time;
  Contact contact{true, norm(run.job.scene.gravity) * std::max(0.4 * time, run.step(time))};
  if (!tied && run.step(time) > 0.0)
    contact.hidden_speed =
        std::min(contact.hidden_speed, hidden_at_rest(run, body, near, interval, run.step(time)));
  double pushed = 0.0;  // what stands still gives no speed
  for (const std::size_t other : near)
    for (const auto* s : {&a, &b})
      if (run.job.bodies[other].motion != Motion::fixed)
        pushed = std::max(pushed, fastest_beside(run, other, *s, velocity(*s)));
  contact.hidden_speed += pushed;
  if (tied) {  // engines may return bodies to a joint by places alone
    const auto *from = row_of(run.job.bodies[body], a), *to = row_of(run.job.bodies[body], b);
    if (from && to) contact.hidden_speed += norm(to->velocity - from->velocity);
  }
  return contact;
}

}  // namespace tripoint
