// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/step_times.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>

#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

std::array<double, 2> clocks() {
  timespec cpu{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

}  // namespace

void StepTimes::begin() { last_ = clocks(); }

void StepTimes::note() {
  const auto now = clocks();
  seconds_.push_back({now[0] - last_[0], now[1] - last_[1]});
  last_ = now;
}

void StepTimes::write() const {
  std::ofstream out(path_);
  for (const auto& [wall, cpu] : seconds_) out << fmt::format("{:.9g} {:.9g}\n", wall, cpu);
  if (!out.flush()) throw EngineError(path_ + ": cannot be written");
}

}  // namespace tripoint::ranks
