// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/engine/stops.hpp"

#include <signal.h>

namespace tripoint {
namespace {

volatile sig_atomic_t asked = 0;
extern "C" void on_stop(int) { asked = 1; }

}  // namespace

void catch_stops() {
  struct sigaction action {};
  action.sa_handler = on_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_asked() noexcept { return asked != 0; }

}  // namespace tripoint
