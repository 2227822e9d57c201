// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/interrupt.hpp"

#include <atomic>
#include <cstring>

#include <fmt/format.h>

#include "core/stop_signals.hpp"

namespace tripoint {
namespace {

std::atomic<int> stop_signal{0};
extern "C" void on_interrupt(int signal) { stop_signal.store(signal); }

}  // namespace

std::string name_of_stop(int signal) {
  return signal == SIGTERM ? "SIGTERM" : signal == SIGHUP ? "SIGHUP (its terminal closed)" : "Ctrl-C";
}

void catch_interrupts() { on_stop_signals(on_interrupt); }

bool interrupted() noexcept { return stop_signal.load() != 0; }

int stopped_by() noexcept { return stop_signal.load(); }

}  // namespace tripoint
