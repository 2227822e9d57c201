// SPDX-License-Identifier: BSD-3-Clause
#include "step/schedule.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace tripoint {
namespace {

/// a step that changes more often would break the time symmetry of kick-drift-kick
constexpr long steps_between_bounds = 32;

}  // namespace

Schedule::Schedule(const std::vector<Event>& events) {
  for (std::size_t n = 0; n < events.size(); ++n) {
    moments_.push_back({events[n].time, n, true});
    if (events[n].until) moments_.push_back({*events[n].until, n, false});
  }
  std::ranges::stable_sort(moments_, {}, &Moment::time);
}

const Schedule::Moment* Schedule::next_until(double time) {
  return has_moments_left() && moments_[next_].time <= time ? &moments_[next_++] : nullptr;
}

double Schedule::stop_before(double time) const {
  return has_moments_left() ? std::min(time, moments_[next_].time) : time;
}

bool Schedule::needs_plan(double stop) const {
  return stretch_.done == stretch_.count || stretch_.end != stop || stretch_.done % steps_between_bounds == 0;
}

double Schedule::plan(double now, double stop, long count) {
  stretch_ = {now, stop, count, 0};
  return (stop - now) / static_cast<double>(count);
}

double Schedule::next_end(double dt) const {
  const Stretch& s = stretch_;
  return s.done + 1 == s.count ? s.end : s.start + static_cast<double>(s.done + 1) * dt;
}

void Schedule::restore(std::size_t moments_past, const Stretch& stretch) {
  if (moments_past > moments_.size())
    throw InputError("the checkpoint has seen more events than the scene has");
  next_ = moments_past;
  stretch_ = stretch;
}

}  // namespace tripoint
