// SPDX-License-Identifier: BSD-3-Clause
#include "step/thread_choice.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace tripoint {
namespace {

/// A machine on which a step takes so long with so many threads [s], and threads are pushed aside so often
/// [1/s].
struct Machine {
  std::function<double(int threads)> step;
  double pushed_aside;
};

/// Steps for so many seconds. @return share of the steps that took all threads
double share_of_all(ThreadChoice& choice, int most, const Machine& machine, double seconds) {
  double now = 0.0, all = 0.0, steps = 0.0;
  while (now < seconds) {
    const double step = machine.step(choice.now());
    all += choice.now() == most ? 1.0 : 0.0;
    steps += 1.0;
    choice.took(step, static_cast<long>(machine.pushed_aside * step));
    now += step;
  }
  return all / steps;
}

const Machine quiet{[](int threads) { return 0.008 / threads; }, 0.0};
// Threads wait for each other
const Machine crowded{[](int threads) { return threads == 1 ? 0.03 : 0.3; }, 200.0};
// Busy, and two are still worth it
const Machine shared{[](int threads) { return threads == 1 ? 0.016 : 0.009; }, 200.0};

TEST(ThreadChoice, TakesAllThreadsWhereNobodyElseWorks) {
  ThreadChoice choice(2);
  EXPECT_EQ(share_of_all(choice, 2, quiet, 30.0), 1.0);
}

TEST(ThreadChoice, TakesOneWhereThreadsWaitForEachOtherAndAllAgainWhenTheMachineIsFree) {
  ThreadChoice choice(2);
  EXPECT_LT(share_of_all(choice, 2, crowded, 60.0), 0.05);
  EXPECT_EQ(choice.now(), 1);
  share_of_all(choice, 2, quiet, 20.0);  // no longer than the greatest patience
  EXPECT_EQ(share_of_all(choice, 2, quiet, 30.0), 1.0);
}

TEST(ThreadChoice, KeepsAllWhereTheyAreFasterOnABusyMachineToo) {
  ThreadChoice choice(2);
  EXPECT_GT(share_of_all(choice, 2, shared, 60.0), 0.95);
}

TEST(ThreadChoice, LosesLittleByLooking) {
  ThreadChoice choice(2);
  share_of_all(choice, 2, crowded, 10.0);
  double seconds = 0.0, steps = 0.0;
  while (seconds < 100.0) {
    const double step = crowded.step(choice.now());
    choice.took(step, static_cast<long>(crowded.pushed_aside * step));
    seconds += step;
    steps += 1.0;
  }
  EXPECT_LT(seconds / steps, 1.2 * crowded.step(1));
}

TEST(ThreadChoice, HasNothingToChooseWithOneThread) {
  ThreadChoice choice(1);
  EXPECT_EQ(share_of_all(choice, 1, crowded, 5.0), 1.0);
}

}  // namespace
}  // namespace tripoint
