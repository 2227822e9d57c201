// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>

namespace tripoint {

/// How many threads the next step takes: all that are given, or one while other work fills the machine.
/// Several threads would then wait for each other longer than they work. It measures: where threads are
/// pushed aside it tries one, keeps the faster choice, and looks again later. Threads do not change a bit of
/// a run, so they can change between two steps.
class ThreadChoice {
 public:
  explicit ThreadChoice(int most) : most_(most), now_(most) {}
  [[nodiscard]] int now() const noexcept { return now_; }
  /// After a step.
  /// @param seconds wall time that it took   @param pushed_aside how often a thread of this process lost its
  /// core to others meanwhile
  void took(double seconds, long pushed_aside);
  /// The same, measured from begin_step() to end_step().
  void begin_step() { begin_ = Clock::now(); }
  void end_step();

 private:
  /// Steps with the same threads, long enough to be compared with others.
  struct Look {
    double seconds = 0.0;
    long steps = 0, pushed_aside = 0;
    [[nodiscard]] bool is_long_enough() const noexcept { return steps >= 4 && seconds >= 0.05; }
    [[nodiscard]] double step() const noexcept { return seconds / static_cast<double>(steps); }
  };
  using Clock = std::chrono::steady_clock;
  void judge();

  int most_, now_;
  Look look_;
  bool tries_ = false;     ///< this look is at the other choice
  double other_ = 0.0;     ///< a step with the choice before, while trying [s]
  double settled_ = 0.0;   ///< since the last comparison [s]
  double patience_ = 0.0;  ///< from one comparison to the next; longer while nothing changes [s]
  Clock::time_point begin_{};
  long pushed_aside_ = 0;  ///< times, as counted after the last step
};

}  // namespace tripoint
