// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>

#include <array>

namespace tripoint {

/// Signals that ask a process to end: Ctrl-C, SIGTERM, and SIGHUP, which comes where its terminal closes.
inline constexpr std::array stop_signals{SIGINT, SIGTERM, SIGHUP};

/// From now on they call this handler. A second Ctrl-C or SIGTERM ends us at once. A second SIGHUP does not,
/// because the system and the shell each send one when a terminal closes. Where SIGHUP is ignored, as after
/// nohup, it stays ignored.
inline void on_stop_signals(void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  for (const int signal : stop_signals) {
    struct sigaction before {};
    const bool stays_ignored =
        signal == SIGHUP && ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    action.sa_flags = signal == SIGHUP ? 0 : static_cast<int>(SA_RESETHAND);
    if (!stays_ignored) ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace tripoint
