// SPDX-License-Identifier: BSD-3-Clause
// Calls about children: what starts one, waits for it, hears or ends it, and bounds it.
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdarg>
#include <new>

#include "faults/seam.hpp"

using namespace fault_seam;

extern "C" {

/// A copy has no thread that could let go of what another one held.
pid_t fork() noexcept {
  NEXT(fork);
  return child_by(Set::fork, "fork", [&] {
    plan().mutex.lock();
    const pid_t child = next();
    if (child == 0)
      new (&plan().mutex) std::recursive_mutex;
    else
      plan().mutex.unlock();
    return child;
  });
}

int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* actions,
                const posix_spawnattr_t* attributes, char* const* argv, char* const* environment) {
  NEXT(posix_spawn);
  errno = 0;
  const int result = child_by(Set::spawn, "posix_spawn",
                              [&] { return next(pid, path, actions, attributes, argv, environment); });
  return result < 0 ? errno : result;
}

int pipe2(int* ends, int flags) noexcept {
  NEXT(pipe2);
  return child_by(Set::pipe, "pipe2", [&] { return next(ends, flags); });
}

int socketpair(int domain, int type, int protocol, int* ends) noexcept {
  NEXT(socketpair);
  return child_by(Set::pipe, "socketpair", [&] { return next(domain, type, protocol, ends); });
}

int poll(pollfd* all, nfds_t n, int limit) {
  NEXT(poll);
  return child_by(Set::poll, "poll", [&] { return next(all, n, limit); });
}

pid_t waitpid(pid_t pid, int* status, int options) {
  NEXT(waitpid);
  return child_by(Set::wait, "waitpid", [&] { return next(pid, status, options); });
}

pid_t wait4(pid_t pid, int* status, int options, rusage* use) noexcept {
  NEXT(wait4);
  return child_by(Set::wait, "wait4", [&] { return next(pid, status, options, use); });
}

int waitid(idtype_t type, id_t id, siginfo_t* end, int options) {
  NEXT(waitid);
  return child_by(Set::wait, "waitid", [&] { return next(type, id, end, options); });
}

int kill(pid_t pid, int signal) noexcept {
  NEXT(kill);
  return child_by(Set::kill, "kill", [&] { return next(pid, signal); });
}

int setrlimit(__rlimit_resource_t what, const rlimit* limit) noexcept {
  NEXT(setrlimit);
  return child_by(Set::limit, "setrlimit", [&] { return next(what, limit); });
}

int prlimit(pid_t pid, __rlimit_resource what, const rlimit* limit, rlimit* before) noexcept {
  NEXT(prlimit);
  return child_by(Set::limit, "prlimit", [&] { return next(pid, what, limit, before); });
}

int prctl(int option, ...) noexcept {
  NEXT(prctl);
  va_list rest;
  va_start(rest, option);
  unsigned long w[4];
  for (unsigned long& word : w) word = va_arg(rest, unsigned long);
  va_end(rest);
  return child_by(Set::limit, "prctl", [&] { return next(option, w[0], w[1], w[2], w[3]); });
}

long syscall(long number, ...) {
  va_list rest;
  va_start(rest, number);
  long w[6];
  for (long& word : w) word = va_arg(rest, long);
  va_end(rest);
  const auto call = [&] { return raw(number, w[0], w[1], w[2], w[3], w[4], w[5]); };
  return number == SYS_pidfd_open ? child_by(Set::pidfd, "pidfd_open", call) : call();
}

int __poll_chk(pollfd* all, nfds_t n, int limit, size_t /*most*/) { return poll(all, n, limit); }
}
