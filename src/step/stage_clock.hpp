// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

/// Where the seconds of a step go.
namespace tripoint {

enum class Stage : std::size_t {
  kick,
  drift,
  change,
  search,
  density,
  state,
  rates,
  bonds,
  correct,
  check,
  bound
};
inline constexpr std::array<std::string_view, 11> stage_names{
    "kick", "drift", "change", "search", "density", "state", "rates", "bonds", "correct", "check", "bound"};
/// Wall seconds that each stage took since they were last set to zero, in the order of Stage.
using StageSeconds = std::array<double, stage_names.size()>;

/// Adds the time from here to the end of the block to a stage. Without a sink it never looks at the clock:
/// two readings cost more than a step of a few particles.
class StageTimer {
 public:
  StageTimer(StageSeconds* sink, Stage stage) : sink_(sink), stage_(stage) {
    if (sink_) begin_ = Clock::now();
  }
  ~StageTimer() {
    if (sink_)
      (*sink_)[static_cast<std::size_t>(stage_)] +=
          std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  StageSeconds* sink_;
  Stage stage_;
  Clock::time_point begin_{};
};

}  // namespace tripoint
