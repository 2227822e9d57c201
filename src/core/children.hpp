// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>

namespace tripoint {

/// How children of ours end is told to us from now on. Who started us may have ignored SIGCHLD, as a shell does after `trap ''
/// CHLD`, and that is handed down: the system then throws the ends of children away, and who waits for one learns nothing. Called
/// before each child that is waited for.
inline void keep_ends_of_children() noexcept {
  struct sigaction action {};
  if (::sigaction(SIGCHLD, nullptr, &action) != 0) return;
  const bool ignored = action.sa_handler == SIG_IGN;
  if (!ignored && (action.sa_flags & SA_NOCLDWAIT) == 0) return;
  if (ignored) action.sa_handler = SIG_DFL;
  action.sa_flags &= ~SA_NOCLDWAIT;
  ::sigaction(SIGCHLD, &action, nullptr);
}

}  // namespace tripoint
