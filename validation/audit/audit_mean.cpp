// SPDX-License-Identifier: BSD-3-Clause
// A rate in contact that places do not follow in the mean: one interval may hide it, many do not.
#include <algorithm>
#include <cmath>

#include "validation/audit/audit_rates.hpp"

namespace tripoint {
namespace {

/// Intervals in which contact acts and nothing is hit, nor in those beside them.
std::vector<std::size_t> lying_intervals(const Audited& run, const JobBody& b, std::size_t body) {
  const std::size_t intervals = run.frames.size() - 1;
  std::vector<char> calm;
  for (std::size_t n = 0; n < intervals; ++n)
    calm.push_back(is_interrupted(run.job, *run.frames[n], *run.frames[n + 1]) || is_hit(run, b, n) ? 0 : 1);
  std::vector<std::size_t> list;
  for (std::size_t n = 1; n + 1 < intervals; ++n)
    if (calm[n - 1] != 0 && calm[n] != 0 && calm[n + 1] != 0 && contact_of(run, body, n).touches)
      list.push_back(n);
  return list;
}

/// Sums over intervals of what way or turn is beyond its rates.
struct Beyond {
  Vec3 sum, change;
  double squares = 0.0, time = 0.0, greatest = 0.0, count = 0.0;

  void take(const Vec3& off, const Vec3& first, const Vec3& last, double duration) {
    sum += off;
    change += last - first;
    squares += dot(off, off);
    time += duration;
    greatest = std::max({greatest, norm(first), norm(last)});
    count += 1.0;
  }
  [[nodiscard]] double mean() const { return norm(sum) / count; }
  [[nodiscard]] double standard_error() const {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / count);
  }
};

/// An engine may return bodies to contact by places in every step, as far as gravity moves them in ten.
constexpr double steps_of_gravity = 10.0;
constexpr double enough = 12.0, share_known = 1e-3;

/// @param length that makes a speed of the rate [m], 1 of a velocity   @param depth pushes of hits [m]
std::string mean_of_all_contradicts(const Audited& run, const Beyond& all, const std::string& words,
                                    double length, double depth) {
  if (all.count < enough) return {};
  const double interval = all.time / all.count;
  const double step = run.step(interval) > 0.0 ? run.step(interval) : interval;
  const double of_contact = steps_of_gravity * norm(run.job.scene.gravity) * step + depth / all.time;
  const double allowed = 5.0 * all.standard_error() + step * norm(all.change) / all.time +
                         share_known * all.greatest + (of_contact > 0.0 ? of_contact / length : 0.0);
  if (all.mean() <= allowed) return {};
  return "contradicts itself: " + words + " in the mean of " + figure(all.count) + " intervals: by " +
         figure(all.mean()) + ", where " + figure(allowed) + " may be";
}

std::string body_contradicts(const Audited& run, const JobBody& b, std::size_t body) {
  Beyond way, turn;
  for (const std::size_t n : lying_intervals(run, b, body)) {
    const auto row = static_cast<std::size_t>(b.index);
    const BodyState &from = run.frames[n]->bodies[row], &to = run.frames[n + 1]->bodies[row];
    const double time = run.frames[n + 1]->time - run.frames[n]->time;
    const Vec3 expected = from.position + 0.5 * time * (from.velocity + to.velocity);
    way.take((1.0 / time) * displacement(run.job.scene, to.position, expected), from.velocity, to.velocity,
             time);
    const Quaternion turned = to.orientation * conjugate(from.orientation);
    const Quaternion by_rates = linear_turn(from.angular_velocity, to.angular_velocity, time);
    turn.take((1.0 / time) * rotation_vector(turned * conjugate(by_rates)), from.angular_velocity,
              to.angular_velocity, time);
  }
  const double depth = depth_of_hits(run, body) + depth_at_start(run, body);
  const std::string name = "`" + b.name + "` ";
  if (auto why = mean_of_all_contradicts(run, way, name + "moves otherwise than its velocities say [m/s]",
                                         1.0, depth);
      !why.empty())
    return why;
  return mean_of_all_contradicts(run, turn, name + "turns otherwise than its angular velocities say [rad/s]",
                                 gyration_radius(b), depth);
}

}  // namespace

std::string rests_at_a_rate(const Audited& run) {
  if (!keeps_bodies(run.job) || run.frames.size() < 2) return {};
  for (std::size_t k = 0; k < run.job.bodies.size(); ++k) {
    const JobBody& b = run.job.bodies[k];
    if (!is_followed(run, b) || is_tied(run.job.scene, b.name)) continue;
    if (auto why = body_contradicts(run, b, k); !why.empty()) return why;
  }
  return {};
}

}  // namespace tripoint
