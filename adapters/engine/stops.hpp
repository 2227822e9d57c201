// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Ctrl-C, SIGTERM and SIGHUP in a process of an engine that can leave a checkpoint.
namespace tripoint {

/// From now on stop signals ask for a checkpoint and an end, as core/stop_signals.hpp says. A second Ctrl-C
/// or SIGTERM ends us at once, and where SIGHUP is ignored it stays ignored.
void catch_stops();
/// Whether one of them has come since.
[[nodiscard]] bool stop_asked() noexcept;

/// Exit code of a run that was stopped and has left a checkpoint.
inline constexpr int exit_interrupted = 130;

}  // namespace tripoint
