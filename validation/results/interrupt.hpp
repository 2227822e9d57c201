// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Ctrl-C and its like: what was complete by then is reported.
namespace tripoint {

/// "Ctrl-C", "SIGTERM" or "SIGHUP (its terminal closed)".
[[nodiscard]] std::string name_of_stop(int signal);

/// From now on Ctrl-C, SIGTERM and SIGHUP (core/stop_signals.hpp) do not end this process. They ask the
/// children to end, kill those that have not within 10 s, and set interrupted().
void catch_interrupts();
[[nodiscard]] bool interrupted() noexcept;
/// The signal that did, 0 while none has.
[[nodiscard]] int stopped_by() noexcept;

}  // namespace tripoint
