// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/run/process.hpp"

/// Engines that somebody else wrote, run by bubblewrap in namespaces of their own. They see no network and no
/// other process. Of the files they see the system's programs, their run, and their own folder without the
/// files of the suite and of git. Limits are set before the engine begins.
namespace tripoint {

/// Whether an engine is one of this program's own: it lies where they do.
[[nodiscard]] bool belongs_to_us(const std::string& executable);

/// From now on `sandboxed` acts. Asked once, before the first engine is. @param out folder of all runs, of
/// which no engine sees any but its own; "" where there is none
/// @param jobs how many engines run at once: each has its part of the free memory and disk
/// @throws EngineError where bubblewrap is not installed, or this machine lets it make no namespaces: nothing
/// is run unguarded then
void sandbox_third_parties(const std::string& out, int jobs = 1);

/// Whether it was called.
[[nodiscard]] bool third_parties_are_sandboxed() noexcept;

/// The child as it is to be started: unchanged where no sandbox is wanted, and where the engine belongs to
/// this program.
/// @param readable files or folders that it may read besides
/// @throws EngineError where the engine's folder holds the user's home
/// @pre spec.folder, where it has one, is all that it may write
[[nodiscard]] ProcessSpec sandboxed(ProcessSpec spec, const std::vector<std::string>& readable = {});

/// The program that draws the pages: it opens third-party files. Where a sandbox is wanted, it sees no more
/// than itself and the report's folder, in which it may change nothing but pages and figures.
/// @param out folder of the report   @param history file that it shows, "" = none
[[nodiscard]] ProcessSpec sandboxed_report(ProcessSpec spec, const std::string& out,
                                           const std::string& history);

}  // namespace tripoint
