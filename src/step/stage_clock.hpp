// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <string_view>

/// Where the seconds of a step go.
namespace tripoint {

enum class Stage : std::size_t { kick, drift, change, search, density, state, rates, bonds, correct, check, bound };
inline constexpr std::array<std::string_view, 11> stage_names{"kick",  "drift", "change",  "search", "density", "state",
                                                              "rates", "bonds", "correct", "check",  "bound"};
/// Wall seconds that each stage took since they were last set to zero, in the order of Stage.
using StageSeconds = std::array<double, stage_names.size()>;

/// Gives the time since its last call to the stage that just ended. Without a sink it never looks at the clock: two readings cost
/// more than a step of a few particles.
class StageClock {
 public:
  explicit StageClock(StageSeconds* sink = nullptr) : sink_(sink) {}
  void start() {
    if (sink_) last_ = Clock::now();
  }
  void ends(Stage stage) {
    if (!sink_) return;
    const auto now = Clock::now();
    (*sink_)[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StageSeconds* sink_;
  Clock::time_point last_{};
};

}  // namespace tripoint
