// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "program/bench/core_pace.hpp"

namespace tripoint::bench {
namespace {

/// Threads that keep the first usable core busy for as long as it lives.
class BusyCore {
 public:
  explicit BusyCore(int threads) {
    for (int n = 0; n < threads; ++n)
      threads_.emplace_back([this] {
        cpu_set_t usable;
        CPU_ZERO(&usable);
        ASSERT_EQ(sched_getaffinity(0, sizeof usable, &usable), 0);
        int core = 0;
        while (!CPU_ISSET(core, &usable)) ++core;
        CPU_ZERO(&usable);
        CPU_SET(core, &usable);
        ASSERT_EQ(sched_setaffinity(0, sizeof usable, &usable), 0);
        while (!end_) continue;
      });
  }
  ~BusyCore() {
    end_ = true;
    for (std::thread& one : threads_) one.join();
  }

 private:
  std::atomic<bool> end_ = false;
  std::vector<std::thread> threads_;
};

bool go_on() noexcept { return false; }
bool stop() noexcept { return true; }

TEST(CorePace, ACoreThatOtherWorkIsOnIsSlow) {
  CorePace pace(1);
  const BusyCore busy(4);
  double sum = 0.0;
  constexpr int looks = 20;
  for (int n = 0; n < looks; ++n) sum += pace.look();
  EXPECT_GT(sum / looks, 1.5);
  EXPECT_EQ(pace.looks(), looks);
  EXPECT_GT(pace.slow_looks(), looks / 4);
}

TEST(CorePace, WaitsForASlowCoreNoLongerThanItsPatience) {
  CorePace pace(1);
  const BusyCore busy(8);
  double longest = 0.0;
  for (int n = 0; n < 10; ++n) longest = std::max(longest, pace.wait_until_fast(0.2, go_on));
  EXPECT_GT(longest, 0.1);
  EXPECT_LT(longest, 5.0);
}

TEST(CorePace, EndsItsWaitWhereItIsToldTo) {
  CorePace pace(1);
  const BusyCore busy(8);
  EXPECT_LT(pace.wait_until_fast(1000.0, stop), 5.0);
}

}  // namespace
}  // namespace tripoint::bench
