// SPDX-License-Identifier: BSD-3-Clause
// A parent-death signal would not do. It comes at the end of the thread that started the child, and only to
// the child itself.
#include "validation/run/watch.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <vector>

#include "validation/run/strays.hpp"

namespace tripoint {
namespace {

// The watcher is a copy of a process with many threads, any of which may have held a lock. So it makes system
// calls only, in memory that was taken before.
struct Watch {
  std::string entry;  // entry in the environment of each process of ours
  std::vector<char> names, text;
  int door = -1;  // the watcher's end of a pair of sockets: the other one closes when we end, however we end
};

/// Whether this file holds the entry; read in pieces that overlap by the length of it.
bool holds_entry(Watch& w, int file) {
  const std::size_t overlap = w.entry.size() - 1;
  for (std::size_t kept = 0;;) {
    const ssize_t n = ::read(file, w.text.data() + kept, w.text.size() - kept);
    if (n <= 0) return false;
    const std::size_t all = kept + static_cast<std::size_t>(n);
    if (::memmem(w.text.data(), all, w.entry.data(), w.entry.size())) return true;
    kept = all < overlap ? all : overlap;
    std::memmove(w.text.data(), w.text.data() + all - kept, kept);
  }
}

/// Kills one process, named by its folder in /proc, if it is ours. @return whether it was
bool kill_if_ours(Watch& w, int proc, const char* name) {
  char* end = nullptr;
  const long pid = std::strtol(name, &end, 10);
  if (pid <= 1 || *end != '\0') return false;
  const int folder = ::openat(proc, name, O_PATH | O_DIRECTORY | O_CLOEXEC);
  const int file = ::openat(folder, "environ", O_RDONLY | O_CLOEXEC);
  const bool ours = file >= 0 && holds_entry(w, file);
  if (ours) ::kill(static_cast<pid_t>(pid), SIGKILL);
  ::close(file);
  ::close(folder);
  return ours;
}

/// Kills every process of ours that it finds. @return whether there was one
bool kill_ours(Watch& w) {
  bool found = false;
  const int proc = ::open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  for (long n = 0; (n = ::syscall(SYS_getdents64, proc, w.names.data(), w.names.size())) > 0;)
    for (long at = 0; at < n;) {
      // The kernel's layout is that of glibc
      const auto* item = reinterpret_cast<const dirent64*>(w.names.data() + at);
      found |= kill_if_ours(w, proc, item->d_name);
      at += item->d_reclen;
    }
  ::close(proc);
  return found;
}

/// Out of reach of signals to our group or terminal, and holding nothing open that others wait for.
void stand_apart(Watch& w) {
  ::setsid();
  ::prctl(PR_SET_NAME, "tripoint-watch");
  sigset_t all;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
  w.door = ::dup2(w.door, 3);
  ::syscall(SYS_close_range, 4u, ~0u, 0u);
  if (::chdir("/") != 0) ::_exit(1);
}

/// Ends when told to, or when all that we left is dead.
[[noreturn]] void watch(Watch& w) {
  stand_apart(w);
  char word = 0;
  ssize_t n = 0;
  while ((n = ::read(w.door, &word, 1)) < 0 && errno == EINTR) {
  }
  if (n == 1) ::_exit(0);
  // For a moment a process that becomes another program shows no environment
  constexpr int quiet_enough = 10, rounds = 3000;
  const timespec pause{0, 20'000'000};
  for (int quiet = 0, round = 0; quiet < quiet_enough && round < rounds; ++round) {
    quiet = kill_ours(w) ? 0 : quiet + 1;
    ::nanosleep(&pause, nullptr);
  }
  ::_exit(0);
}

pid_t watched = -1, watcher = -1;
int door = -1;

/// An ordinary exit: every run has ended by now, there is nothing to look for.
void dismiss() {
  if (::getpid() != watched) return;  // a copy of us that ends is not our end
  ::send(door, "q", 1, MSG_NOSIGNAL);
  ::close(door);
  ::waitpid(watcher, nullptr, 0);
}

void start(const std::string& mark) {
  Watch w;
  w.entry = std::string(stray_mark) + "=" + mark + mark_end;
  w.names.resize(32768);
  w.text.resize(65536 + w.entry.size());
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  w.door = ends[0];
  door = ends[1];  // a child that becomes an engine does not keep it
  watched = ::getpid();
  watcher = ::fork();
  if (watcher == 0) watch(w);
  ::close(ends[0]);
  if (watcher < 0) return static_cast<void>(::close(ends[1]));
  std::atexit(dismiss);
}

}  // namespace

void watch_for_our_end(const std::string& mark) {
  static std::once_flag once;
  std::call_once(once, start, mark);
}

}  // namespace tripoint
