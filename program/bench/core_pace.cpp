// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/core_pace.hpp"

#include <sched.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <future>
#include <thread>

#include "program/bench/clock.hpp"

namespace tripoint::bench {
namespace {

constexpr double seconds_of_look = 0.015;
constexpr std::chrono::milliseconds between_looks{30};
constexpr int looks_to_learn = 20;
constexpr std::size_t one_in = 10;  ///< of all looks sets what is fast: a single fast one need not come again
/// Looks at quiet cores differ by some hundredths, and a narrow one has 1.5 or more
constexpr double slow = 1.15;
constexpr int operations = 40000;

/// A loop that does as much at once as the core can: eight chains that do not wait for each other.
void turn() {
  static thread_local std::array<std::uint64_t, 8> chains{1, 2, 3, 4, 5, 6, 7, 8};
  auto x = chains;
  for (int n = 0; n < operations; ++n)
    for (auto& one : x) {
      one ^= one << 7;
      one ^= one >> 9;
    }
  chains = x;  // so that the loop has a result
}

/// [s] a turn, in the mean of a look.
double look_at(int core) {
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(core, &only);
  // Of this thread; where that is refused, the system chooses the core
  sched_setaffinity(0, sizeof only, &only);
  int turns = 0;
  const Clock::time_point begin = Clock::now();
  double took = 0.0;
  for (; took < seconds_of_look; took = since(begin)) {
    turn();
    ++turns;
  }
  return took / turns;
}

std::vector<int> usable_cores() {
  cpu_set_t usable;
  CPU_ZERO(&usable);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof usable, &usable) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(core, &usable)) cores.push_back(core);
  if (cores.empty()) cores.push_back(0);
  return cores;
}

}  // namespace

CorePace::CorePace(int cores) : cores_(std::max(1, cores)) {
  for (int n = 0; n < looks_to_learn; ++n) look();
  looks_ = slow_looks_ = 0;
}

double CorePace::look() {
  std::vector<int> cores = usable_cores();
  cores.resize(std::min(cores.size(), static_cast<std::size_t>(cores_)));
  std::vector<std::future<double>> looks;
  for (const int core : cores) looks.push_back(std::async(std::launch::async, look_at, core));
  double slowest = 0.0;
  for (auto& one : looks) slowest = std::max(slowest, one.get());
  times_.insert(std::upper_bound(times_.begin(), times_.end(), slowest), slowest);
  const double ratio = slowest / times_[times_.size() / one_in];
  ++looks_;
  if (ratio > slow) ++slow_looks_;
  return ratio;
}

double CorePace::wait_until_fast(double patience, bool (*stop)() noexcept) {
  if (look() <= slow) return 0.0;
  const Clock::time_point begin = Clock::now();
  while (since(begin) < patience && !stop()) {
    std::this_thread::sleep_for(between_looks);
    if (look() <= slow) return since(begin);
  }
  return since(begin);
}

}  // namespace tripoint::bench
