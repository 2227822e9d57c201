// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/engine/stops.hpp"

#include <signal.h>

#include "core/stop_signals.hpp"

namespace tripoint {
namespace {

volatile sig_atomic_t asked = 0;
extern "C" void on_stop(int) { asked = 1; }

}  // namespace

void catch_stops() { on_stop_signals(on_stop); }

bool stop_asked() noexcept { return asked != 0; }

}  // namespace tripoint
