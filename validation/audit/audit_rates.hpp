// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/audit/audit_parts.hpp"

/// How far a change may be from what its rate says. Places with velocities, and orientations with angular
/// velocities, share it.
namespace tripoint {

/// A rate at the two ends of an interval between frames, and at the frames before and after it; NaN where
/// there is none.
struct Rates {
  Vec3 before, first, last, after;

  [[nodiscard]] bool known() const { return finite(first) && finite(last); }
  [[nodiscard]] Vec3 mean() const { return 0.5 * (first + last); }
  [[nodiscard]] Vec3 change() const { return last - first; }
  [[nodiscard]] double greatest() const;
  /// Largest second difference at the two ends: what the trapezoidal rule over the frames does not see. Of
  /// two frames alone, their difference.
  [[nodiscard]] double roughness() const;
};
[[nodiscard]] Rates rates_at(const std::vector<Vec3>& in_time, std::size_t interval);

/// Whether an event takes hold of bodies between two frames: what is held, gripped, united or parted does not
/// move by its rate.
[[nodiscard]] bool is_interrupted(const Job&, const Snapshot& a, const Snapshot& b);

/// Whether a body may touch another one in an interval between frames: the boxes that they sweep come within
/// three spacings.
struct Contact {
  bool touches = false;
  /// That contact may give and take again, unseen by the frames: gravity's of a step at least, and that of
  /// others [m/s]
  double hidden_speed = 0.0;
};
/// Whether a joint or a spring holds the body: it pushes as contact does.
[[nodiscard]] bool is_tied(const Scene&, const std::string& body);
[[nodiscard]] Contact contact_of(const Audited&, std::size_t body, std::size_t interval);

/// A body that is rigid, free and whole in every frame.
[[nodiscard]] bool is_followed(const Audited&, const JobBody&);
/// Acceleration that weight and friction give without a hit, in gravities.
inline constexpr double weight_and_friction = 1.5;
/// Whether a body is hit in an interval: its velocities change by more than weight and friction can give.
[[nodiscard]] bool is_hit(const Audited&, const JobBody&, std::size_t interval);
/// Least radius of gyration: at it contact turns the body [m].
[[nodiscard]] double gyration_radius(const JobBody&);

/// Depth to which a body overlaps others at the start [m].
[[nodiscard]] double depth_at_start(const Audited&, std::size_t body);
/// Depths to which it sinks in others within a step of each hit, summed [m].
[[nodiscard]] double depth_of_hits(const Audited&, std::size_t body);

/// How far an engine may push one body out of others by places alone, which no velocity shows: by as much as
/// it overlaps them at the start, or sank in a hit within a step.
class PushOut {
 public:
  PushOut(const Audited& run, std::size_t body) : run_(run), body_(body) {}
  /// Interval by interval, in order. @param excess way that the velocities do not show [m]
  /// @return whether the depths so far allow it, which are used up by it
  [[nodiscard]] bool allows(std::size_t interval, double excess);
  /// To be called for each interval first
  void enter(std::size_t interval);

 private:
  const Audited& run_;
  std::size_t body_;
  double depth_ = 0.0;  // [m]
  bool knows_start_ = false;
};

/// Turn in an interval whose angular velocity changes linearly.
[[nodiscard]] Quaternion linear_turn(const Vec3& first, const Vec3& last, double time);

/// Largest difference between a mean rate over an interval and the mean of its ends: the error of the
/// trapezoidal rule where the rate bends or jumps in between, and five digits.
/// @param touches whether contact may act: it jumps more than once in an interval
[[nodiscard]] double allowed_difference(const Rates&, bool touches);
/// Largest lag of an engine of first order with steps h, as a rate: h/2 of the change of the rate.
[[nodiscard]] Vec3 largest_lag(const Audited&, const Rates&, double interval);
/// Roundings of a coordinate of this size over the steps of an interval, and of six digits in an output, as a
/// rate.
[[nodiscard]] double rounding_rate(const Audited&, double size, double output, double interval);

}  // namespace tripoint
