// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/step_times.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>

#include "core/errors.hpp"

namespace tripoint::ranks {
StepTimes::Clocks StepTimes::clocks() {
  timespec cpu{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
          static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec)};
}

void StepTimes::begin() {
  parts_.clear();
  last_ = clocks();
}

void StepTimes::end_part() {
  const Clocks now = clocks();
  parts_.push_back({now[0] - last_[0], now[1] - last_[1]});
  last_ = now;
}

void StepTimes::end_step() {
  end_part();
  steps_.push_back(parts_);
  parts_.clear();
}

void StepTimes::write() const {
  std::ofstream out(path_);
  for (const auto& parts : steps_) {
    for (std::size_t k = 0; k < parts.size(); ++k) out << fmt::format("{}{:.9g} {:.9g}", k ? " " : "", parts[k][0], parts[k][1]);
    out << "\n";
  }
  if (!out.flush()) throw EngineError(path_ + ": cannot be written");
}

}  // namespace tripoint::ranks
