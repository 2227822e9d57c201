// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/metrics/frame_error.hpp"
#include "validation/metrics/frames.hpp"

namespace tripoint {
namespace {

std::string at_time(const Snapshot& s) { return " at t = " + std::to_string(s.time) + " s"; }

bool dead(const Snapshot& s, std::size_t i) { return i < s.id.size() && s.id[i] == -1; }

std::string not_finite(const Snapshot& s) {
  const auto scalar = [&](const std::vector<double>& column, const char* name) -> std::string {
    for (std::size_t i = 0; i < column.size(); ++i)
      if (!std::isfinite(column[i]) && !dead(s, i)) return std::string(name) + " of particle " + std::to_string(i) + " is not finite" + at_time(s);
    return {};
  };
  const auto vector = [&](const std::vector<Vec3>& column, const char* name) -> std::string {
    for (std::size_t i = 0; i < column.size(); ++i)
      if (!finite(column[i]) && !dead(s, i)) return std::string(name) + " of particle " + std::to_string(i) + " is not finite" + at_time(s);
    return {};
  };
  for (const auto& why : {vector(s.position, "position"), vector(s.velocity, "velocity"), scalar(s.temperature, "temperature"),
                          scalar(s.temperature_error, "temperature_error"), scalar(s.density, "density"), scalar(s.pressure, "pressure")})
    if (!why.empty()) return why;
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    if (finite(s.bodies[b].position) != finite(s.bodies[b].velocity)) return "body row " + std::to_string(b) + " is not finite" + at_time(s);
  return {};
}

std::string wrong_masses(const Snapshot& s, const InitialState& initial) {
  if (!s.mass.empty() && s.mass.size() < initial.size()) return "masses are missing" + at_time(s);
  for (std::size_t i = 0; i < std::min(s.mass.size(), initial.size()); ++i)
    if (!dead(s, i) && !(std::abs(s.mass[i] - initial.mass[i]) <= 1e-12 * initial.mass[i]))
      return "the mass of particle " + std::to_string(i) + " has changed" + at_time(s);
  return {};
}

const JobBody* body_of(const Job& job, const InitialState& initial, std::size_t i) {
  const auto source = i < initial.source.size() ? static_cast<std::size_t>(initial.source[i]) : job.bodies.size();
  return source < job.bodies.size() ? &job.bodies[source] : nullptr;
}

/// The first frame must be the job's start: else ids are swapped, units wrong, or the time axis shifted.
std::string other_start(const Job& job, const InitialState& initial, const Snapshot& first) {
  const double tolerance = 1e-6 * (job.scene.spacing > 0.0 ? job.scene.spacing : 1.0);
  for (std::size_t i = 0; i < std::min(first.position.size(), initial.size()); ++i) {
    const auto* body = body_of(job, initial, i);
    const bool placed = body && body->motion == Motion::prescribed && !body->keyframes.empty();
    if (placed || dead(first, i)) continue;
    if (!(norm(displacement(job.scene, first.position[i], initial.position[i])) <= tolerance))
      return "the first frame is not the job's start: particle " + std::to_string(i) + " is elsewhere (other units, permuted ids or a shifted time?)";
  }
  return {};
}

bool should_move(const Job& job) {
  const bool held = std::any_of(job.bodies.begin(), job.bodies.end(), [](const JobBody& b) { return b.motion == Motion::fixed; });
  return std::any_of(job.bodies.begin(), job.bodies.end(), [&](const JobBody& b) {
    if (b.motion == Motion::fixed) return false;
    const bool flies = norm(b.velocity) > 0.0 || norm(b.angular_velocity) > 0.0;
    return flies || b.keyframes.size() > 1 || (!held && b.motion == Motion::free && norm(job.scene.gravity) > 0.0);
  });
}

bool should_conduct(const Job& job, const InitialState& initial) {
  const auto& T = initial.temperature;
  const bool uneven = !T.empty() && *std::max_element(T.begin(), T.end()) > *std::min_element(T.begin(), T.end());
  return uneven && std::any_of(job.scene.materials.begin(), job.scene.materials.end(), [](const Material& m) { return m.conductivity.value_or(0.0) > 0.0; });
}

bool same_places(const Snapshot& a, const Snapshot& b) { return !a.position.empty() && a.position == b.position; }

/// Some particle has a velocity in both frames (a pause between keyframes is no fault).
bool both_fast(const Snapshot& a, const Snapshot& b) {
  for (std::size_t i = 0; i < std::min(a.velocity.size(), b.velocity.size()); ++i)
    if (norm(a.velocity[i]) > 0.0 && norm(b.velocity[i]) > 0.0) return true;
  return false;
}

std::string frozen(const Job& job, const InitialState& initial, const Frames& frames) {
  if (frames.size() < 2) return {};
  const bool moves = should_move(job);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    const auto &a = *frames[n - 1], &b = *frames[n];
    if (moves && both_fast(a, b) && same_places(a, b)) return "frozen: no particle moves from t = " + std::to_string(a.time) + " to " + std::to_string(b.time) + " s, yet they have velocities";
  }
  const auto &first = *frames.front(), &last = *frames.back();
  if (moves && same_places(first, last) && first.velocity == last.velocity) return "frozen: nothing has moved by the end, though the scene does";
  if (should_conduct(job, initial) && !last.temperature.empty() && last.temperature == first.temperature) return "frozen: no temperature has changed by the end";
  return {};
}

}  // namespace

std::string audit(const Job& job, const InitialState& initial, const Trajectory& run) {
  const auto frames = frames_of_job(job, initial, run);
  if (!frames.problem.empty()) return frames.problem;
  for (const auto* s : frames.list) {
    if (auto why = not_finite(*s); !why.empty()) return why;
    if (auto why = wrong_masses(*s, initial); !why.empty()) return why;
  }
  if (auto why = other_start(job, initial, *frames.list.front()); !why.empty()) return why;
  return frozen(job, initial, frames.list);
}

}  // namespace tripoint
