// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>

#include "metrics/frames.hpp"

/// A truth that a test states outright.
namespace tripoint::test {

using Numbers = std::map<std::string, double, std::less<>>;

/// A truth that is one state at all times, and what a test gives it: numbers, and what they are measured
/// along.
class Known : public Reference {
 public:
  Known(Snapshot state, Numbers numbers, Measuring measuring = {})
      : state_(std::move(state)), numbers_(std::move(numbers)), measuring_(measuring) {}
  [[nodiscard]] Snapshot at(double time) const override {
    auto state = state_;
    state.time = time;
    return state;
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    return in_time && quantity == "value" ? in_time(time) : number(quantity);
  }
  [[nodiscard]] Measuring measuring() const override { return measuring_; }
  [[nodiscard]] std::optional<double> uncertainty(std::string_view, double time) const override {
    return deviation ? std::optional(deviation(time)) : std::nullopt;
  }

  /// The value as it changes, and its standard uncertainty
  std::function<double(double)> in_time, deviation;

 private:
  Snapshot state_;
  Numbers numbers_;
  Measuring measuring_;
};

inline Measuring along(std::size_t axis) {
  Measuring m;
  m.axis = axis;
  return m;
}

/// The value of a run beside a truth that is the run's start as it was prepared.
inline MetricValue value(const Still& f, const MetricChoice& choice, const Numbers& numbers = {},
                         const Measuring& measuring = {}) {
  const Known truth(Still(f.s).run.frames.front(), numbers, measuring);
  return evaluate(choice, f.s.job, f.s.initial, f.run, truth);
}

inline Still still_blocks(int intervals = 4) {
  auto s = blocks();
  s.job.scene.gravity = {0, 0, -10.0};
  set_times(s, 1.0, intervals);
  return Still(std::move(s));
}

}  // namespace tripoint::test
