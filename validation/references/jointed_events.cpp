// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/references/jointed_motion.hpp"

/// Events of a motion with joints: friction that starts and stops, limits that are hit and left.
namespace tripoint {
namespace {

constexpr double rests = 1e-8;    ///< rate below which a joint is at rest at an event [rad/s] or [m/s]
constexpr double touches = 1e-9;  ///< from a limit [rad] or [m]
constexpr int most_changes = 50;

int sign_of(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

/// How far a coordinate is from its nearer limit, and which that is.
struct Room {
  double size;
  int side;
};
Room room_of(const Joint& j, double value) {
  const auto [low, high] = *j.limits;
  return value - low < high - value ? Room{value - low, -1} : Room{high - value, 1};
}

}  // namespace

bool JointedMotion::has_events() const {
  return std::ranges::any_of(job_.scene.joints, [](const Joint& j) { return j.limits || j.friction > 0.0; });
}

std::vector<double> JointedMotion::reactions(const State& s) const {
  std::vector<double> out(modes_.size(), 0.0);
  const Rows all = rows(s, true);
  if (all.gradient.empty()) return out;
  const Vector free = inverse_mass_times(s, forces(s));
  Vector right(static_cast<Eigen::Index>(all.bias.size())), lambda;
  for (Eigen::Index k = 0; k < right.size(); ++k) {
    const auto row = static_cast<std::size_t>(k);
    right[k] = -all.bias[row] - all.gradient[row].dot(free);
  }
  (void)correction(s, all, right, &lambda);
  for (std::size_t k = 0; k < all.joint.size(); ++k)
    if (all.joint[k] >= 0) out[static_cast<std::size_t>(all.joint[k])] = lambda[static_cast<Eigen::Index>(k)];
  return out;
}

double JointedMotion::margin(const State& s) const {
  double least = 1.0;
  const std::vector<double> holds = reactions(s);
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const Joint& j = job_.scene.joints[n];
    const Mode& p = modes_[n];
    if (p.limit != 0) {
      least = std::min(least, -p.limit * holds[n] + (j.friction > 0.0 ? j.friction : 0.0));
      continue;
    }
    if (j.limits) least = std::min(least, room_of(j, coordinate(s, j).value).size);
    if (j.friction > 0.0)
      least =
          std::min(least, p.slides == 0 ? j.friction - std::abs(holds[n]) : p.slides * coordinate(s, j).rate);
  }
  return least;
}

/// Regula falsi with every fourth step a bisection.
double JointedMotion::to_event(State& s, double H) const {
  const State start = s;
  double near = 0.0, far = H, near_margin = margin(start), far_margin = -1.0;
  State at_far = s;
  for (int k = 0; k < 100 && far - near > 1e-15 && far_margin < -event_error; ++k) {
    const double middle =
        k == 0 ? far
               : near + (k % 4 == 3 || near_margin <= 0.0 ? 0.5 : near_margin / (near_margin - far_margin)) *
                            (far - near);
    State there = start;
    for (double left = middle; left > 0.0;) left -= step(there, left);
    const double now = margin(there);
    if (now < 0.0) {
      far = middle;
      far_margin = now;
      at_far = there;
    } else {
      near = middle;
      near_margin = now;
    }
  }
  s = at_far;
  return far;
}

void JointedMotion::hit(State& s) const {
  Rows all = rows(s, false);
  std::vector<double> target(all.value.size(), 0.0);
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const Joint& j = job_.scene.joints[n];
    if (j.motor && j.motor->speed) {
      add_coordinate(all, s, n, 0.0);
      target.push_back(*j.motor->speed);
    }
    if (!j.limits) continue;
    const Coordinate now = coordinate(s, j);
    const Room room = room_of(j, now.value);
    if (modes_[n].limit == 0 && (room.size > touches || room.side * now.rate <= 0.0)) continue;
    const double back = std::abs(j.restitution * now.rate) < rests ? 0.0 : -j.restitution * now.rate;
    modes_[n].limit = back == 0.0 ? room.side : 0;
    add_coordinate(all, s, n, 0.0);
    target.push_back(back);
  }
  Vector right(static_cast<Eigen::Index>(target.size()));
  for (Eigen::Index k = 0; k < right.size(); ++k)
    right[k] = target[static_cast<std::size_t>(k)] - all.gradient[static_cast<std::size_t>(k)].dot(s.motion);
  if (!target.empty()) s.motion += correction(s, all, right);
}

void JointedMotion::settle(const State& s) const {
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const double rate = job_.scene.joints[n].friction > 0.0 ? coordinate(s, job_.scene.joints[n]).rate : 0.0;
    modes_[n].slides = std::abs(rate) < rests ? 0 : sign_of(rate);
  }
  for (int change = 0; change < most_changes; ++change) {
    const std::vector<double> holds = reactions(s);
    bool any = false;
    for (std::size_t n = 0; n < modes_.size() && !any; ++n) {
      const Joint& j = job_.scene.joints[n];
      Mode& p = modes_[n];
      if (p.limit != 0) {  // the limit lets go where it would have to pull more than friction does
        any = p.limit * holds[n] > j.friction;
        if (any) p = {j.friction > 0.0 ? -p.limit : 0, 0};
      } else if (j.friction > 0.0 && p.slides == 0 && std::abs(holds[n]) > j.friction &&
                 std::abs(coordinate(s, j).rate) < rests) {
        p.slides = -sign_of(holds[n]);
        any = true;
      }
    }
    if (!any) return;
  }
}

void JointedMotion::pass_event(State& s) const {
  for (std::size_t n = 0; n < modes_.size(); ++n) {
    const Joint& j = job_.scene.joints[n];
    if (!j.limits || modes_[n].limit != 0) continue;
    const Coordinate now = coordinate(s, j);
    const Room room = room_of(j, now.value);
    if (room.size <= touches && std::abs(now.rate) < rests) modes_[n].limit = room.side;
  }
  hit(s);
  settle(s);
  project(s);
}

}  // namespace tripoint
