// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "validation/run/sandbox_sums.hpp"

/// Engines are seen only as processes: started in a group of their own, bounded, and paid for by the group.
namespace tripoint {

struct ProcessSpec {
  std::vector<std::string> argv;                   ///< argv[0] is the path of the program
  std::string folder;                              ///< working folder; empty = ours
  std::map<std::string, std::string> environment;  ///< added to ours
  double wall_limit = 600.0;                       ///< [s]; then the whole group is killed
  /// File that keeps stderr: its first MiB and its last lines; empty = none
  std::string log;
  std::function<void(double)> progress;  ///< called with 0..1 for each line `progress X` of stderr
  /// Called with the rest of each line `status REST` of stderr, of 400 bytes at most
  std::function<void(const std::string&)> status;
  /// Ctrl-C does not end it: it shows the results that are complete by then
  bool outlives_interrupt = false;
  /// argv is bubblewrap's, which leaves the process that it starts to us: that one is paid for. It is given
  /// no variable of ours.
  bool in_sandbox = false;
  SandboxSums most;  ///< what passes them is killed
  std::string lent;  ///< folder that belongs to the sandbox's user while the program runs
};

struct ProcessEnd {
  enum class How { exited, signalled, timed_out, interrupted, not_started } how = How::not_started;
  int code = 0;               ///< exit code, or the number of the signal that ended it, or us
  std::string passed;         ///< why we killed it, in words
  std::string output;         ///< stdout, at most 4 MiB
  std::string log_tail;       ///< last lines of stderr, or why it could not start
  double wall_s = 0.0;        ///< [s]
  double cpu_s = 0.0;         ///< user and system of the whole group [s]
  double instructions = 0.0;  ///< in user space, of the whole group; 0 = this machine counts none
  double peak_bytes = 0.0;    ///< greatest resident size of one process of the group
};

/// Runs a program to its end, its limit or our Ctrl-C, whichever is first. Nothing of its group survives, nor
/// does it where we are killed. Never throws for a fault of the program.
[[nodiscard]] ProcessEnd run_process(const ProcessSpec&);

/// Held while a program is started, and by all code that uses HDF5. Its files are not close-on-exec, so a
/// child would inherit them for a moment; and Debian's library is not thread-safe.
[[nodiscard]] std::mutex& no_spawn_mutex();

/// "exited with code 3", "was killed by signal 9 (Killed)", "was stopped after 600 s", ...
[[nodiscard]] std::string describe(const ProcessEnd&);

/// The last line of a log that says something, for a reason in one line: "; its last words: ...", or nothing.
[[nodiscard]] std::string last_words(const std::string& log);

}  // namespace tripoint
