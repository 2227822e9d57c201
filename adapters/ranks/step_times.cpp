// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/step_times.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <fstream>

#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_clock() {
  timespec cpu{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
  return static_cast<double>(cpu.tv_sec) + 1e-9 * static_cast<double>(cpu.tv_nsec);
}

}  // namespace

void StepTimes::begin() {
  parts_.clear();
  in_call_ = false;
  part_began_ = wall_clock();
  cpu_ = cpu_clock();
}

void StepTimes::begin_call() {
  if (in_call_) return;
  in_call_ = true;
  call_began_ = wall_clock();
}

void StepTimes::end_part() {
  const double now = wall_clock(), cpu = cpu_clock();
  const double worked_until = in_call_ ? call_began_ : now;
  parts_.push_back({worked_until - part_began_, now - worked_until, cpu - cpu_});
  part_began_ = now;
  cpu_ = cpu;
  in_call_ = false;
}

void StepTimes::end_step() {
  end_part();
  steps_.push_back(parts_);
  parts_.clear();
}

void StepTimes::write() const {
  std::ofstream out(path_);
  for (const auto& parts : steps_) {
    const char* blank = "";
    for (const Part& part : parts) {
      out << fmt::format("{}{:.9g} {:.9g} {:.9g}", blank, part.work, part.call, part.cpu);
      blank = " ";
    }
    out << "\n";
  }
  if (!out.flush()) throw EngineError(path_ + ": cannot be written");
}

}  // namespace tripoint::ranks
