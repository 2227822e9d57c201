// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.hpp"

namespace tripoint {

/// When things happen: the begins and ends of the scene's events, and the equal steps towards the next of
/// them or the next output. Steps are planned when a stretch begins, so that a continued run keeps to the
/// plan that it was cut in.
class Schedule {
 public:
  /// An event's begin or end.
  struct Moment {
    double time;        ///< [s]
    std::size_t event;  ///< in Scene::events
    bool begins;
  };
  /// Equal steps towards one end.
  struct Stretch {
    double start = 0.0, end = 0.0;  ///< [s]
    long count = 0, done = 0;       ///< steps
  };

  Schedule() = default;
  explicit Schedule(const std::vector<Event>&);

  /// The next begin or end of an event that is not later than `time` [s], which is then past; null where
  /// there is none.
  const Moment* next_until(double time);
  [[nodiscard]] bool has_moments_left() const noexcept { return next_ < moments_.size(); }
  /// Where steps towards `time` [s] must stop: there, or at an event on the way [s].
  [[nodiscard]] double stop_before(double time) const;

  /// Whether steps must be planned anew: the stretch is done, or leads elsewhere, or its bound is 32 steps
  /// old.
  [[nodiscard]] bool needs_plan(double stop) const;
  /// Equal steps from `now` to `stop` [s]. @return the length of one [s]
  double plan(double now, double stop, long count);
  /// End of the step that is next, the last one exactly where the stretch ends [s]. @param dt length of a
  /// step [s]
  [[nodiscard]] double next_end(double dt) const;
  void count_step() { ++stretch_.done; }
  /// Steps are planned anew before the next one.
  void drop_plan() { stretch_ = {}; }

  /// Into and out of a checkpoint. @throws InputError where more moments are past than the scene has
  [[nodiscard]] std::size_t moments_past() const noexcept { return next_; }
  [[nodiscard]] const Stretch& stretch() const noexcept { return stretch_; }
  void restore(std::size_t moments_past, const Stretch&);

 private:
  std::vector<Moment> moments_;  ///< in order of time
  std::size_t next_ = 0;
  Stretch stretch_;
};

}  // namespace tripoint
