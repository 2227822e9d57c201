// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

/// How far a rate at one frame is from the mean of its neighbours, and how far it may be.
struct Spike {
  double found = 0.0, allowed = 0.0;
};

/// A rate that bends shows it in the frames around, too. The frame itself has no voice in what is allowed.
Spike spike_at(const std::vector<Vec3>& rate, std::size_t n) {
  constexpr double two_digits = 0.02;
  const Vec3 &before = rate[n - 1], &after = rate[n + 1];
  double bend = 0.0;
  if (n >= 3) bend = norm(rate[n - 3] - 2.0 * before + after);
  if (n + 3 < rate.size()) bend = std::max(bend, norm(before - 2.0 * after + rate[n + 3]));
  return {norm(rate[n] - 0.5 * (before + after)), bend + two_digits * std::max(norm(before), norm(after))};
}

bool is_free_about(const Audited& run, std::size_t body, std::size_t n) {
  return !contact_of(run, body, n - 1).touches && !contact_of(run, body, n).touches;
}

/// Mean rate over an interval by its places or orientations.
Vec3 mean_rate(const Audited& run, const JobBody& body, Vec3 BodyState::*member, std::size_t interval) {
  const auto row = static_cast<std::size_t>(body.index);
  const Snapshot &before = *run.frames[interval], &after = *run.frames[interval + 1];
  const BodyState &from = before.bodies[row], &to = after.bodies[row];
  const Vec3 change = member == &BodyState::velocity
                          ? displacement(run.job.scene, to.position, from.position)
                          : rotation_vector(to.orientation * conjugate(from.orientation));
  return (1.0 / (after.time - before.time)) * change;
}

/// A hit that turns a body throws it, too, and one that throws it turns it.
bool is_hit_by_the_other(const Audited& run, const JobBody& b, Vec3 BodyState::*member, std::size_t n) {
  const bool turns = member == &BodyState::angular_velocity;
  const auto row = static_cast<std::size_t>(b.index);
  const Vec3 BodyState::*other = turns ? &BodyState::velocity : &BodyState::angular_velocity;
  const auto jump = [&](std::size_t from, std::size_t to) {
    return norm(run.frames[to]->bodies[row].*other - run.frames[from]->bodies[row].*other) *
           (turns ? 1.0 : gyration_radius(b));
  };
  const double weight = norm(run.job.scene.gravity) * (run.frames[n + 1]->time - run.frames[n]->time);
  return std::max(jump(n - 1, n), jump(n, n + 1)) > weight_and_friction * weight;
}

/// Speed that contact may give and take again, by the frames around one that may be wrong.
double hidden_about(const Audited& run, std::size_t body, std::size_t n) {
  double most = 0.0;
  if (n >= 2) most = contact_of(run, body, n - 2).hidden_speed;
  if (n + 2 < run.frames.size()) most = std::max(most, contact_of(run, body, n + 1).hidden_speed);
  return most;
}

/// In contact a body may be hit and hit back. Then its ways or turns to this frame and from it are not those
/// of the frames before and after.
bool is_denied(const Audited& run, std::size_t body, Vec3 BodyState::*member, const std::vector<Vec3>& rate,
               std::size_t n, const Spike& spike) {
  if (is_free_about(run, body, n)) return true;
  const auto& b = run.job.bodies[body];
  const double hidden =
      hidden_about(run, body, n) / (member == &BodyState::velocity ? 1.0 : gyration_radius(b));
  const double large = 0.5 * std::max(norm(rate[n - 1]), norm(rate[n + 1]));
  const Vec3 smooth = 0.5 * (rate[n - 1] + rate[n + 1]);
  const double off =
      std::max(norm(mean_rate(run, b, member, n - 1) - smooth), norm(mean_rate(run, b, member, n) - smooth));
  return spike.found > spike.allowed + hidden + large && off < 0.1 * spike.found &&
         !is_hit_by_the_other(run, b, member, n);
}

/// The rate of a body in all frames; empty where it is not there in one.
std::vector<Vec3> rates_of(const Audited& run, const JobBody& body, Vec3 BodyState::*rate) {
  std::vector<Vec3> all;
  const auto row = static_cast<std::size_t>(body.index);
  for (const auto* s : run.frames) {
    if (row >= s->bodies.size() || !is_there(s->bodies[row])) return {};
    all.push_back(s->bodies[row].*rate);
  }
  return all;
}

/// Whether frames follow the turn: where a body turns far between them, they say nothing of it.
bool is_seen(const Audited& run, const std::vector<Vec3>& spin, std::size_t n) {
  constexpr double far = 0.5;  // [rad]
  const double time = run.frames[n + 1]->time - run.frames[n]->time;
  return std::max(norm(spin[n - 1]), norm(spin[n + 1])) * time < far;
}

/// What roundings of places and turns leave of a rate: noise of a body at rest is no spike.
double rounding_at(const Audited& run, std::size_t body, Vec3 BodyState::*member, std::size_t n) {
  const double time = run.frames[n + 1]->time - run.frames[n]->time;
  if (member == &BodyState::angular_velocity) return rounding_rate(run, 1.0, 1e-6, time);
  const auto row = static_cast<std::size_t>(run.job.bodies[body].index);
  return rounding_rate(run, norm(run.frames[n]->bodies[row].position), 1e-6 * run.job.scene.spacing, time);
}

std::string spike_in(const Audited& run, std::size_t body, Vec3 BodyState::*member, const char* what) {
  const auto& b = run.job.bodies[body];
  const auto rate = rates_of(run, b, member);
  constexpr std::size_t enough = 6;
  for (std::size_t n = 1; rate.size() >= enough && n + 1 < rate.size(); ++n) {
    Spike spike = spike_at(rate, n);
    spike.allowed += rounding_at(run, body, member, n);
    if (spike.found <= spike.allowed || !is_denied(run, body, member, rate, n, spike) ||
        (member == &BodyState::angular_velocity && !is_seen(run, rate, n)))
      continue;
    return "contradicts itself: the " + std::string(what) + " of `" + b.name +
           "` leaves those before and after it" + at_time(*run.frames[n]) + " by " + figure(spike.found) +
           ", where " + figure(spike.allowed) + " may be";
  }
  return {};
}

}  // namespace

std::string leaves_for_one_frame(const Audited& run) {
  if (!keeps_bodies(run.job)) return {};
  for (std::size_t b = 0; b < run.job.bodies.size(); ++b) {
    const auto& body = run.job.bodies[b];
    if (body.index < 0 || body.phase != Phase::rigid || body.motion != Motion::free) continue;
    for (const auto& [member, what] : {std::pair(&BodyState::velocity, "velocity"),
                                       std::pair(&BodyState::angular_velocity, "angular velocity")})
      if (auto why = spike_in(run, b, member, what); !why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
