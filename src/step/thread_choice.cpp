// SPDX-License-Identifier: BSD-3-Clause
#include "step/thread_choice.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace tripoint {
namespace {

constexpr double least_patience = 1.0, most_patience = 16.0;  ///< [s]
/// Times a second that a thread is pushed aside on a machine that has other work; alone it is a few
constexpr double busy = 20.0;
constexpr double much_less = 0.9;  ///< a change must save a tenth

/// How often threads of this process lost their core to others until now.
long times_pushed_aside() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_nivcsw;
}

}  // namespace

void ThreadChoice::end_step() {
  const long pushed = times_pushed_aside();
  took(std::chrono::duration<double>(Clock::now() - begin_).count(), pushed - pushed_aside_);
  pushed_aside_ = pushed;
}

void ThreadChoice::took(double seconds, long pushed_aside) {
  if (most_ == 1) return;
  look_.seconds += seconds;
  look_.steps += 1;
  look_.pushed_aside += pushed_aside;
  settled_ += seconds;
  if (look_.is_long_enough()) judge();
}

void ThreadChoice::judge() {
  const Look look = look_;
  look_ = {};
  if (tries_) {
    tries_ = false;
    settled_ = 0.0;
    const bool gains = look.step() < much_less * other_;
    patience_ = gains ? least_patience : std::min(most_patience, 2.0 * patience_);
    if (!gains) now_ = now_ == most_ ? 1 : most_;
    return;
  }
  const bool is_crowded = static_cast<double>(look.pushed_aside) > busy * look.seconds;
  if (settled_ < patience_ || (now_ == most_ && !is_crowded)) return;
  patience_ = std::max(patience_, least_patience);
  other_ = look.step();
  tries_ = true;
  now_ = now_ == most_ ? 1 : most_;
}

}  // namespace tripoint
