// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/motion.hpp"
#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

bool is_pushed(const Job& job, const JobBody& b) {
  if (b.motion == Motion::fixed) return false;
  const bool held = std::any_of(job.bodies.begin(), job.bodies.end(),
                                [](const JobBody& other) { return other.motion == Motion::fixed; });
  const bool flies = norm(b.velocity) > 0.0 || norm(b.angular_velocity) > 0.0;
  return flies || b.keyframes.size() > 1 ||
         (!held && b.motion == Motion::free && norm(job.scene.gravity) > 0.0);
}

bool should_move(const Job& job) {
  return std::any_of(job.bodies.begin(), job.bodies.end(),
                     [&](const JobBody& b) { return is_pushed(job, b); });
}

bool same_places(const Snapshot& a, const Snapshot& b) {
  return !a.position.empty() && a.position == b.position;
}

/// Some particle moves the other way: it may have been thrown, and come back.
bool turned_round(const Snapshot& a, const Snapshot& b) {
  for (std::size_t i = 0; i < std::min(a.velocity.size(), b.velocity.size()); ++i)
    if (dot(a.velocity[i], b.velocity[i]) < 0.0) return true;
  return false;
}

/// Some particle moves the same way in both frames. It has not turned back between them (a pause between
/// keyframes is no fault). It moves by more than the speed that a body at rest keeps in the last digits.
bool goes_on(const Job& job, const Snapshot& a, const Snapshot& b) {
  for (std::size_t i = 0; i < std::min(a.velocity.size(), b.velocity.size()); ++i)
    if (dot(a.velocity[i], b.velocity[i]) > 0.0 &&
        norm(a.velocity[i]) * (b.time - a.time) > 1e-12 * job.scene.spacing)
      return true;
  return false;
}

/// Some fixed or led body is there, on which others may come to rest under gravity.
bool has_support(const Job& job) {
  return std::any_of(job.bodies.begin(), job.bodies.end(),
                     [](const JobBody& b) { return b.motion != Motion::free; });
}

/// Whether free motion goes farther in a time than a coordinate in single precision resolves. A body that has
/// come to rest on another creeps by less.
/// @param falls whether gravity moves it, which it does not where the body lies
bool is_resolved(const Job& job, const Snapshot& a, double time, bool falls) {
  constexpr double single = 6e-8;  // half a unit in the last of 24 bits
  double most = 0.0, place = job.scene.spacing;
  for (const Vec3& v : a.velocity) most = std::max(most, norm(v));
  for (const Vec3& x : a.position) place = std::max(place, norm(x));
  const bool led = std::any_of(job.bodies.begin(), job.bodies.end(),
                               [](const JobBody& b) { return b.keyframes.size() > 1; });
  return led || (most + (falls ? norm(job.scene.gravity) * time : 0.0)) * time > single * place;
}

/// Time in which a way is added to a coordinate: of single precision a substep, of which a step has four at
/// most. What is less than half a unit is lost in each.
double time_of_one_sum(const Audited& run, double interval) {
  const double step = run.step(interval);
  return run.is_single() && step > 0.0 ? 0.25 * step : interval;
}

/// Whether the way between two frames is longer than the rounding error.
bool goes_far(const Job& job, const Snapshot& a, double time) {
  double most = 0.0;
  for (const Vec3& v : a.velocity) most = std::max(most, norm(v));
  for (const JobBody& b : job.bodies) most = std::max(most, norm(b.velocity));
  const bool led = std::any_of(job.bodies.begin(), job.bodies.end(),
                               [](const JobBody& b) { return b.keyframes.size() > 1; });
  return led || (most + norm(job.scene.gravity) * time) * time > 1e-10 * job.scene.spacing;
}

/// A whole number of turns of a body that does nothing but spin.
bool turns_back(const Job& job, const JobBody& b, double time) {
  if (!is_pushed(job, b)) return true;
  const bool spins_only = norm(b.velocity) == 0.0 && b.keyframes.size() < 2 &&
                          (b.motion != Motion::free || norm(job.scene.gravity) == 0.0);
  const double turns = norm(b.angular_velocity) * time / (2.0 * std::numbers::pi);
  return spins_only && turns > 0.5 && std::abs(turns - std::round(turns)) < 1e-6 * turns;
}

/// Keyframes that lead each body back to where it was: positions and rotations at both times are the same.
bool led_back(const JobBody& b, double from, double to) {
  if (b.motion != Motion::prescribed || b.keyframes.size() < 2) return false;
  const auto then = prescribed_state(b.keyframes, {}, {}, {}, from),
             now = prescribed_state(b.keyframes, {}, {}, {}, to);
  return norm(now.position - then.position) < 1e-12 && angle_between(now.rotation, then.rotation) < 1e-9;
}

/// The case's own exact solution is at both times in the same place with the same velocities: then a right
/// run is, too.
bool truth_comes_back(const Job& job, const InitialState& initial, double from, double to) {
  try {
    const auto truth = make_reference(job.reference, job, initial);
    const Snapshot then = truth->at(from), now = truth->at(to);
    const double tolerance = 1e-6 * job.scene.spacing;
    if (then.position.empty() || then.position.size() != now.position.size()) return false;
    for (std::size_t i = 0; i < then.position.size(); ++i)
      if (!(norm(now.position[i] - then.position[i]) <= tolerance)) return false;
    return true;
  } catch (const std::exception&) {
    return false;  // it knows no states, or does not fit
  }
}

/// Whether a right run may have the same places and velocities at both times.
bool may_come_back(const Job& job, const InitialState& initial, double from, double to) {
  const bool by_itself = std::all_of(job.bodies.begin(), job.bodies.end(), [&](const JobBody& b) {
    return turns_back(job, b, to - from) || led_back(b, from, to);
  });
  return by_itself || truth_comes_back(job, initial, from, to);
}

/// Pairs so near that heat must flow between them within the run: both conduct, one at least is free to warm,
/// and their temperatures differ.
bool should_conduct(const Job& job, const InitialState& initial) {
  const auto& T = initial.temperature;
  if (T.empty() || *std::max_element(T.begin(), T.end()) == *std::min_element(T.begin(), T.end()))
    return false;
  const auto material = [&](std::size_t i) {
    return job.scene.materials.at(static_cast<std::size_t>(initial.material[i]));
  };
  const auto held = [&](std::size_t i) {
    const auto source =
        i < initial.source.size() ? static_cast<std::size_t>(initial.source[i]) : job.bodies.size();
    const auto* b = source < job.bodies.size() ? &job.bodies[source] : nullptr;
    return b && b->temperature_held;
  };
  std::vector<std::size_t> conducting;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (const Material m = material(i);
        m.conductivity.value_or(0.0) > 0.0 && m.heat_capacity.value_or(0.0) > 0.0)
      conducting.push_back(i);
  bool must = false;
  const double dx = job.scene.spacing;
  for_near_pairs(
      job.scene, initial.position, conducting, 1.2 * dx, [&](std::size_t i, std::size_t j, const Vec3&) {
        if (must || held(i) || T[i] == T[j]) return;
        const Material m = material(i), other = material(j);
        const double k = std::min(*m.conductivity, *other.conductivity),
                     share = k * job.scene.end_time / (m.density * *m.heat_capacity * dx * dx);
        must = share * std::abs(T[j] - T[i]) > 1e-9 * T[i];  // far above the last digit that a run writes
      });
  return must;
}

/// Name of a free body that no other is near, and that keeps place and velocity between two frames though
/// gravity pulls it; empty = none. It says nothing of scenes with events, which may hold a body, with inflow,
/// or with half spaces, which go on beyond their particles.
std::string hangs_in_the_air(const Job& job, const InitialState& initial, const Snapshot& a,
                             const Snapshot& b) {
  const double time = b.time - a.time, g = norm(job.scene.gravity);
  const bool says_nothing =
      g == 0.0 || !job.scene.events.empty() || !job.scene.inflows.empty() ||
      a.velocity.size() != initial.size() || b.velocity.size() != initial.size() ||
      initial.source.size() != initial.size() ||
      std::any_of(job.scene.bodies.begin(), job.scene.bodies.end(),
                  [](const Body& body) { return body.shape.kind == Shape::Kind::half_space; });
  if (says_nothing || !is_resolved(job, a, time, true)) return {};
  std::vector<char> hangs(job.bodies.size(), 0);
  for (std::size_t k = 0; k < hangs.size(); ++k) hangs[k] = job.bodies[k].motion == Motion::free;
  std::vector<std::size_t> alive;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    if (norm(b.velocity[i] - a.velocity[i]) > 0.5 * g * time)
      hangs[static_cast<std::size_t>(initial.source[i])] = 0;
    if (!dead(a, i)) alive.push_back(i);
  }
  if (std::none_of(hangs.begin(), hangs.end(), [](char h) { return h; })) return {};
  for_near_pairs(job.scene, a.position, alive, 3.0 * job.scene.spacing,
                 [&](std::size_t i, std::size_t j, const Vec3&) {
                   if (initial.source[i] != initial.source[j])
                     hangs[static_cast<std::size_t>(initial.source[i])] = 0;
                 });
  const auto found = std::find(hangs.begin(), hangs.end(), 1);
  return found == hangs.end() ? "" : job.bodies[static_cast<std::size_t>(found - hangs.begin())].name;
}

}  // namespace

std::string frozen(const Audited& run) {
  const auto& job = run.job;
  const auto& initial = run.initial;
  const auto& frames = run.frames;
  if (frames.size() < 2) return {};
  const bool moves = should_move(job);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    const auto &a = *frames[n - 1], &b = *frames[n];
    if (!same_places(a, b)) continue;
    const double time = b.time - a.time;
    if (moves && goes_on(job, a, b) && goes_far(job, a, time) &&
        is_resolved(job, a, time_of_one_sum(run, time), !has_support(job)) &&
        !may_come_back(job, initial, a.time, b.time))
      return "frozen: no particle moves from t = " + std::to_string(a.time) + " to " +
             std::to_string(b.time) + " s, yet they have velocities";
    if (const auto body = hangs_in_the_air(job, initial, a, b);
        !body.empty() && !truth_comes_back(job, initial, a.time, b.time))
      return "frozen: `" + body + "` hangs in the air from t = " + std::to_string(a.time) + " to " +
             std::to_string(b.time) + " s";
  }
  const auto &first = *frames.front(), &last = *frames.back();
  if (moves && same_places(first, last) && !turned_round(first, last) &&
      goes_far(job, first, last.time - first.time) && !may_come_back(job, initial, first.time, last.time))
    return "frozen: nothing has moved by the end, though the scene does";
  if (!last.temperature.empty() && last.temperature == first.temperature && should_conduct(job, initial))
    return "frozen: no temperature has changed by the end";
  return {};
}

}  // namespace tripoint
