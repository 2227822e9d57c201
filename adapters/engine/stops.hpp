// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Ctrl-C and SIGTERM in a process of an engine that can leave a checkpoint.
namespace tripoint {

/// From now on Ctrl-C and SIGTERM ask for a checkpoint and an end; a second one ends us at once.
void catch_stops();
/// Whether one of them has come since.
[[nodiscard]] bool stop_asked() noexcept;

/// Exit code of a run that was stopped and has left a checkpoint.
inline constexpr int exit_interrupted = 130;

}  // namespace tripoint
