// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tripoint {

/// Greatest sums over all processes and files of an engine. No limit of one process bounds these.
struct SandboxSums {
  double memory = 0.0;    ///< [bytes], 0 = unbounded
  int processes = 0;      ///< 0 = unbounded
  double bytes = 0.0;     ///< of files in its folder, also of removed ones that are open, 0 = unbounded
  std::size_t files = 0;  ///< in its folder, and of a sandbox in memory, 0 = unbounded
  int at_once = 1;        ///< engines that share the disk
};

/// Entries of the folder of any run: an engine that writes more writes without end.
inline constexpr std::size_t most_files = 20'000;

/// Sum of some lines `KEY:  N kB` of a file [bytes].
[[nodiscard]] double kilobytes(const std::string& file, const std::vector<std::string>& keys);
/// Memory that new work may take on this machine now, or in the control group that we are in [bytes].
[[nodiscard]] double free_memory();

/// User and group that third-party engines run as where root calls us: it owns nothing.
inline constexpr unsigned sandbox_user = 65534;

/// Looks at all processes below one, and at a folder, a few times a second.
class SandboxWatch {
 public:
  /// At most three quarters of the disk's free space are given away, in parts to all that run at once.
  SandboxWatch(const SandboxSums& most, std::string folder);
  /// @return why it must end: "the sandbox has ..."; empty while nothing is passed, or where it is no time to
  /// look again
  [[nodiscard]] std::string passed(pid_t outermost);
  /// The same of what is left where all processes have ended. Where files pass their sum, all that came since
  /// the start goes: a full disk would stop every other run.
  [[nodiscard]] std::string passed_at_end() const;

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string look(pid_t outermost, Clock::time_point now);
  [[nodiscard]] std::string of_memory(const std::vector<pid_t>& all) const;
  [[nodiscard]] std::string of_files(const std::vector<pid_t>& all) const;
  [[nodiscard]] bool stands_still(const std::vector<pid_t>& all, Clock::time_point now);
  [[nodiscard]] std::string whose() const;
  SandboxSums most_;
  bool is_sandbox_;
  std::string folder_;
  std::set<std::string> at_start_;                                 ///< what the folder held
  double free_memory_at_start_ = 0.0, free_space_at_start_ = 0.0;  ///< [bytes]
  Clock::time_point next_{}, last_look_{};
  Clock::duration still_for_{};  ///< for how long nothing of it has run
};

/// A folder that belongs to the sandbox's user for a while, and then to us again, with all that lies in it.
/// "" = none.
class LentFolder {
 public:
  explicit LentFolder(std::string folder);
  ~LentFolder();
  LentFolder(const LentFolder&) = delete;
  LentFolder& operator=(const LentFolder&) = delete;

 private:
  std::string folder_;
};

/// A control group with the sums as its bounds, where this user may make one; the kernel keeps them then,
/// without a moment's delay.
class ControlGroup {
 public:
  explicit ControlGroup(const SandboxSums& most);
  ~ControlGroup();
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;
  /// The sum for which the kernel has ended a process, in words; empty where it has ended none.
  [[nodiscard]] std::string passed() const;
  /// The command, begun inside of the group; the command itself where there is none.
  [[nodiscard]] std::vector<std::string> begun_inside(const std::vector<std::string>& argv) const;

 private:
  double memory_ = 0.0;
  std::vector<std::filesystem::path> folders_;  ///< one for each hierarchy
};

}  // namespace tripoint
