// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

namespace tripoint {

/// From now on the system tells us how our children end. Our parent may have ignored SIGCHLD, as a shell does
/// after `trap '' CHLD`, and we inherit that. The system then throws the ends of children away, and a wait
/// for one learns nothing. Called before each child that is waited for.
inline void keep_ends_of_children() noexcept {
  struct sigaction action {};
  if (::sigaction(SIGCHLD, nullptr, &action) != 0) return;
  const bool ignored = action.sa_handler == SIG_IGN;
  if (!ignored && (action.sa_flags & SA_NOCLDWAIT) == 0) return;
  if (ignored) action.sa_handler = SIG_DFL;
  action.sa_flags &= ~SA_NOCLDWAIT;
  ::sigaction(SIGCHLD, &action, nullptr);
}

/// Whether the child has ended, or its end is not to be had any more. The end stays to be waited for.
inline bool has_ended(pid_t child) noexcept {
  siginfo_t end{};
  return ::waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         end.si_pid == child;
}

/// @param limit wall clock [s]
inline bool ends_within(pid_t child, double limit) noexcept {
  using Clock = std::chrono::steady_clock;
  constexpr double longest = 1000.0, look = 10.0;  // of one wait [ms]; between looks where nothing wakes us
  const auto start = Clock::now();
  pollfd wait{static_cast<int>(::syscall(SYS_pidfd_open, child, 0)), POLLIN, 0};
  bool ended = has_ended(child);
  while (!ended) {
    const double left = 1e3 * limit - std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (left <= 0.0) break;
    // Without a descriptor (a kernel before 5.3, or none to spare) poll passes the entry over and only lets
    // time go by.
    ::poll(&wait, 1, 1 + static_cast<int>(std::min(left, wait.fd < 0 ? look : longest)));
    ended = has_ended(child);
  }
  if (wait.fd >= 0) ::close(wait.fd);
  return ended;
}

/// How a child ended.
struct ChildEnd {
  bool in_time = true;  ///< false: it was killed at the limit
  /// As waitpid tells it; an end that nobody tells counts as a death, never as a good one
  int status = SIGKILL;
};

/// Waits for a child of ours and kills it at the limit. @param limit wall clock [s]
inline ChildEnd end_of_child(pid_t child, double limit) noexcept {
  ChildEnd end;
  end.in_time = ends_within(child, limit);
  if (!end.in_time) ::kill(child, SIGKILL);
  while (::waitpid(child, &end.status, 0) < 0 && errno == EINTR) {
  }
  return end;
}

}  // namespace tripoint
