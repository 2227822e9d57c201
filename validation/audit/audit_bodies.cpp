// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

/// Sums over the particles of one body.
struct Sum {
  double mass = 0.0, fastest = 0.0;
  Vec3 off, momentum;
  /// It reaches so far along a periodic direction that its centre depends on where one begins
  bool wraps = false;
};

/// Whether a body's arm is so long along a periodic direction that its nearest image is not sure.
bool wraps(const Scene& scene, const Vec3& arm) {
  for (std::size_t k = 0; k < 3; ++k)
    if (scene.periodic[k] && std::abs(arm[k]) > 0.25 * ((*scene.max)[k] - (*scene.min)[k])) return true;
  return false;
}

/// Row of each particle's body, or nothing where the engine does not say it and it may have changed.
const std::vector<int>* rows_of(const Audited& run, const Snapshot& s) {
  const std::vector<int>& of = s.body.empty() && keeps_bodies(run.job) ? run.initial.body : s.body;
  return of.size() == s.position.size() && s.velocity.size() == s.position.size() ? &of : nullptr;
}

std::vector<Sum> sums_of(const Audited& run, const Snapshot& s, const std::vector<int>& of,
                         const std::vector<double>& mass) {
  std::vector<Sum> sums(s.bodies.size());
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (of[i] < 0 || static_cast<std::size_t>(of[i]) >= sums.size() || dead(s, i)) continue;
    const auto b = static_cast<std::size_t>(of[i]);
    const Vec3 arm = displacement(run.job.scene, s.position[i], s.bodies[b].position);
    sums[b].wraps = sums[b].wraps || wraps(run.job.scene, arm);
    sums[b].mass += mass[i];
    sums[b].off += mass[i] * arm;
    sums[b].momentum += mass[i] * s.velocity[i];
    sums[b].fastest = std::max(sums[b].fastest, norm(s.velocity[i]));
  }
  return sums;
}

std::string apart_from_the_mean(const Audited& run, const Snapshot& s, const std::vector<Sum>& sums) {
  for (std::size_t b = 0; b < sums.size(); ++b) {
    if (!(sums[b].mass > 0.0) || sums[b].wraps || !is_there(s.bodies[b])) continue;
    const double off = norm(sums[b].off) / sums[b].mass,
                 faster = norm(s.bodies[b].velocity - sums[b].momentum / sums[b].mass);
    if (off > 1e-3 * run.job.scene.spacing)
      return "body row " + std::to_string(b) + " is " + std::to_string(off) +
             " m from the centre of its particles" + at_time(s);
    if (faster > 1e-3 * std::max(sums[b].fastest, norm(s.bodies[b].velocity)))
      return "body row " + std::to_string(b) + " moves otherwise than its particles, by " +
             std::to_string(faster) + " m/s" + at_time(s);
  }
  return {};
}

/// A row has the mass of its particles, to what single precision leaves of a sum.
std::string heavier_than_its_particles(const Audited& run, const Snapshot& s, const std::vector<Sum>& sums) {
  for (const auto& b : run.job.bodies) {
    const auto row = static_cast<std::size_t>(b.index);
    if (b.index < 0 || b.motion != Motion::free || row >= sums.size() || !is_there(s.bodies[row])) continue;
    if (const double mass = sums[row].mass; mass > 0.0 && std::abs(s.bodies[row].mass - mass) > 1e-4 * mass)
      return row_name(run, row) + " has another mass than its particles: " + figure(s.bodies[row].mass) +
             " kg beside " + figure(mass) + " kg" + at_time(s);
  }
  return {};
}

/// A rigid body's particles stand around its centre as its orientation says, and turn by its angular
/// velocity.
std::string apart_from_its_turn(const Audited& run, const Snapshot& s, const std::vector<Sum>& sums) {
  const auto& initial = run.initial;
  for (std::size_t i = 0; i < std::min(initial.size(), s.position.size()); ++i) {
    const auto* body = body_of(run, i);
    if (!body || body->index < 0 || body->phase != Phase::rigid || body->motion != Motion::free) continue;
    const auto row = static_cast<std::size_t>(body->index);
    if (row >= s.bodies.size() || !is_there(s.bodies[row]) || sums[row].wraps) continue;
    const BodyState& b = s.bodies[row];
    const Vec3 arm = rotate(b.orientation, initial.position[i] - body->properties.centre);
    const double off = norm(displacement(run.job.scene, s.position[i], b.position) - arm);
    if (off > 2e-3 * (run.job.scene.spacing + norm(arm)))
      return row_name(run, row) + " is turned otherwise than its particles: number " + std::to_string(i) +
             " is " + std::to_string(off) + " m from where the orientation places it" + at_time(s);
    const double faster = norm(s.velocity[i] - b.velocity - cross(b.angular_velocity, arm));
    if (faster > 2e-3 * std::max(sums[row].fastest, norm(b.velocity) + norm(b.angular_velocity) * norm(arm)))
      return row_name(run, row) + " turns otherwise than its particles: number " + std::to_string(i) +
             " is faster by " + std::to_string(faster) + " m/s than the angular velocity says" + at_time(s);
  }
  return {};
}

}  // namespace

std::string apart_from_its_particles(const Audited& run, const Snapshot& s) {
  const auto* of = rows_of(run, s);
  const std::vector<double>& mass = s.mass.empty() ? run.initial.mass : s.mass;
  if (!of || mass.size() != s.position.size()) return {};
  const auto sums = sums_of(run, s, *of, mass);
  if (auto why = apart_from_the_mean(run, s, sums); !why.empty()) return why;
  if (!keeps_bodies(run.job)) return {};
  if (auto why = heavier_than_its_particles(run, s, sums); !why.empty()) return why;
  return apart_from_its_turn(run, s, sums);
}

}  // namespace tripoint
