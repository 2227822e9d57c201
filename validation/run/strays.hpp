// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <sys/resource.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

/// Processes that a child left in sessions of their own, where a signal to its group does not reach them.
namespace tripoint {

/// The environment variable that marks a child and, by inheritance, all that it starts.
inline constexpr const char* stray_mark = "TRIPOINT_RUN";

/// Ends each part of a mark but the last: a mark made of another one is `OTHER/PART`.
inline constexpr char mark_end = '/';

/// The mark that all of ours are made of; itself made of the mark that this process carries, where one of us
/// started it.
[[nodiscard]] const std::string& our_stray_mark();

/// A mark that no other child of any tripoint on this machine has.
[[nodiscard]] std::string new_stray_mark();

/// Children of a process, the newest first. Empty where the kernel keeps no such list.
[[nodiscard]] std::vector<pid_t> children_of(pid_t);

/// Resources of a process that came to us when its parent ended, and of the processes that it waited for. Any
/// of our threads may have buried it. Nothing while it runs, or where it never came to us. Told once.
[[nodiscard]] std::optional<rusage> use_of_orphan(pid_t);

/// Kills every process that carries this mark, or one made of it, in its environment, and those that it
/// starts meanwhile. One that takes the mark away is not found.
void end_strays(const std::string& mark);

}  // namespace tripoint
