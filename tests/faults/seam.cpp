// SPDX-License-Identifier: BSD-3-Clause
// Stands between a program and the C library (LD_PRELOAD), and lets some of its calls fail: the n-th that changes a file below a
// folder, or the n-th that asks for memory. Programs are tested as they are shipped; nothing of this is in them.
//
//   FAULT_PROCESS   beginning of the name of the process that is meant; others are left alone
//   FAULT_FOLDER    calls on files below it count
//   FAULT_AT        which call fails, from 1; 0 = none, calls are counted only. Several: "7,30", each with its kind
//   FAULT_KIND      eio, enospc, erofs, edquot, eintr: the call fails so; short: half of it is done, as may be;
//                   before, half, after: the process is killed before the call, half way through it, after it;
//                   lost: it is killed, and what no fsync has made durable is undone, but for a beginning whose length FAULT_SEED
//                   draws; clock: from then on the date jumps by years at every look; memory: the n-th call for memory gives
//                   none. With "+sticky" all later calls fail too
//   FAULT_LOG       a line a call that counts, or the one that failed: number, operation, path; of calls for memory their number
//   at the end
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

extern "C" void* __libc_malloc(size_t);
extern "C" void* __libc_calloc(size_t, size_t);
extern "C" void* __libc_realloc(void*, size_t);

namespace {

#define NEXT(name) static auto* const next = reinterpret_cast<decltype(&(name))>(dlsym(RTLD_NEXT, #name))

const char* said(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Whether this is the process that is meant. No memory is asked for.
bool is_meant() {
  const char* process = said("FAULT_PROCESS");
  char name[64] = "";
  const int f = static_cast<int>(syscall(SYS_openat, AT_FDCWD, "/proc/self/comm", O_RDONLY | O_CLOEXEC));
  if (f < 0) return false;
  const long n = syscall(SYS_read, f, name, sizeof name - 1);
  syscall(SYS_close, f);
  return *process && n > 0 && std::strncmp(name, process, std::strlen(process)) == 0;
}

[[noreturn]] void die() {
  syscall(SYS_kill, getpid(), SIGKILL);
  for (;;) pause();
}

/// What a loss of power would undo: a file that came to be, bytes that were written or cut off, another name.
struct Unsynced {
  enum class What { made, bytes, renamed } what;
  std::string path, old_path;                        ///< old_path: of a renamed file
  off_t at = 0, size = 0;                            ///< where bytes were written; size of the file before
  std::string bytes;                                 ///< that were there
  bool existed = false;                              ///< what a renamed file replaced
  long rename = 0;                                   ///< number of this change, where it is a rename
  std::vector<std::pair<long, std::string>> former;  ///< renames that moved the file since, each with the name that it had before
};

constexpr const char* sticky_word = "+sticky";

/// One call that fails, or all from it on.
struct Fault {
  long at = 0;
  std::string kind;
  bool sticky = false;
};

/// Parts of a text between commas.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::vector<Fault> faults_asked() {
  const std::vector<std::string> places = parts_of(said("FAULT_AT")), kinds = parts_of(said("FAULT_KIND"));
  std::vector<Fault> faults;
  for (size_t n = 0; n < places.size() && n < kinds.size(); ++n) {
    const size_t word = kinds[n].find(sticky_word);
    faults.push_back({std::atol(places[n].c_str()), kinds[n].substr(0, word), word != std::string::npos});
  }
  return faults;
}

struct Plan {
  std::vector<Fault> faults = faults_asked();
  long seed = std::atol(said("FAULT_SEED"));
  std::string folder = said("FAULT_FOLDER"), log = said("FAULT_LOG");
  bool meant = is_meant();
  bool counts_only = faults.size() == 1 && faults[0].at == 0;
  bool loses = std::ranges::any_of(faults, [](const Fault& f) { return f.kind == "lost"; });
  bool jumps = false;  ///< the date does
  long calls = 0;
  std::vector<Unsynced> unsynced;
  long renames = 0;
  std::recursive_mutex mutex;
};

Plan*& made_plan() {
  static Plan* made = new Plan;  // never destroyed: programs write while they end
  return made;
}

Plan& plan() { return *made_plan(); }

std::string path_of(int fd) {
  char link[64], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, sizeof path);
  return std::string(path, n > 0 ? static_cast<size_t>(n) : 0);
}

std::string absolute(const char* path) {
  char folder[4096];
  return *path == '/' || !getcwd(folder, sizeof folder) ? path : std::string(folder) + "/" + path;
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

void note(const char* operation, const std::string& path) {
  if (plan().log.empty()) return;
  const std::string line = std::to_string(plan().calls) + " " + operation + " " + path + "\n";
  const int f =
      static_cast<int>(syscall(SYS_openat, AT_FDCWD, plan().log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (f < 0) return;
  syscall(SYS_write, f, line.data(), line.size());
  syscall(SYS_close, f);
}

std::string bytes_at(const std::string& path, off_t at, size_t count) {
  std::string bytes(count, '\0');
  const int f = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path.c_str(), O_RDONLY | O_CLOEXEC));
  const long n = f >= 0 ? syscall(SYS_pread64, f, bytes.data(), count, at) : 0;
  if (f >= 0) syscall(SYS_close, f);
  bytes.resize(n > 0 ? static_cast<size_t>(n) : 0);
  return bytes;
}

off_t size_of(const std::string& path) {
  struct stat about {};
  return stat(path.c_str(), &about) == 0 ? about.st_size : -1;
}

void undo(const Unsynced& u) {
  if (u.what == Unsynced::What::made) {
    syscall(SYS_unlinkat, AT_FDCWD, u.path.c_str(), 0);
    return;
  }
  if (u.what == Unsynced::What::renamed) syscall(SYS_renameat, AT_FDCWD, u.path.c_str(), AT_FDCWD, u.old_path.c_str());
  if (u.what == Unsynced::What::renamed && !u.existed) return;
  const int f = static_cast<int>(syscall(SYS_openat, AT_FDCWD, u.path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (f < 0) return;
  syscall(SYS_pwrite64, f, u.bytes.data(), u.bytes.size(), u.at);
  syscall(SYS_ftruncate, f, u.size);
  syscall(SYS_close, f);
}

/// What a rename that is undone had moved has its former name again: else the making of a file that took another's place would be
/// undone on that other one.
void call_as_before(long rename) {
  for (Unsynced& u : plan().unsynced) {
    if (u.former.empty() || u.former.back().first != rename) continue;
    u.path = u.former.back().second;
    u.former.pop_back();
  }
}

/// The power goes: of what was not durable a beginning is left.
void lose() {
  auto& all = plan().unsynced;
  const size_t kept = all.empty() ? 0 : static_cast<size_t>(plan().seed * 2654435761UL % (all.size() + 1));
  for (size_t n = all.size(); n > kept; --n) {
    undo(all[n - 1]);
    if (all[n - 1].what == Unsynced::What::renamed) call_as_before(all[n - 1].rename);
  }
}

void remember_bytes(const std::string& path, off_t at, size_t count) {
  if (!plan().loses) return;
  plan().unsynced.push_back({Unsynced::What::bytes, path, "", at, size_of(path), bytes_at(path, at, count), true, 0, {}});
}

/// After an fsync of a file its bytes are durable, after that of a folder the names in it.
void made_durable(const std::string& path) {
  std::erase_if(plan().unsynced,
                [&](const Unsynced& u) { return u.what == Unsynced::What::bytes ? u.path == path : folder_of(u.path) == path; });
}

enum class Fate { passes, fails, half_and_on, half_and_dies, done_and_dies };

/// What a fault of that kind does to such a call.
Fate fate_of(const std::string& kind, const char* operation) {
  if (kind == "clock") plan().jumps = true;
  if (kind == "clock") return Fate::passes;
  if ((kind == "eintr" || kind == "short") && std::strcmp(operation, "write") != 0)
    return Fate::passes;  // only a write to a disk may be cut short
  if (kind == "lost") lose();
  if (kind == "lost" || kind == "before") die();
  if (kind == "half") return Fate::half_and_dies;
  if (kind == "after") return Fate::done_and_dies;
  if (kind == "short") return Fate::half_and_on;
  errno = kind == "enospc" ? ENOSPC : kind == "erofs" ? EROFS : kind == "edquot" ? EDQUOT : kind == "eintr" ? EINTR : EIO;
  return Fate::fails;
}

/// What becomes of a call that changes a file. Where it fails, errno says why.
Fate fate(const char* operation, const std::string& path) {
  Plan& p = plan();
  if (!p.meant || p.folder.empty() || path.rfind(p.folder, 0) != 0) return Fate::passes;
  ++p.calls;
  if (p.counts_only) note(operation, path);
  for (const Fault& f : p.faults) {
    if (f.at == 0 || f.kind == "memory" || p.calls < f.at || (p.calls > f.at && !f.sticky)) continue;
    if (p.calls == f.at) note(operation, path);
    if (const Fate found = fate_of(f.kind, operation); found != Fate::passes) return found;
  }
  return Fate::passes;
}

/// A call that is done whole or not at all. @param call does it
template <class Call>
auto whole(const char* operation, const std::string& path, Call call) -> decltype(call()) {
  const std::lock_guard lock(plan().mutex);
  const Fate f = fate(operation, path);
  if (f == Fate::fails) return static_cast<decltype(call())>(-1);
  if (f == Fate::half_and_dies) die();
  const auto result = call();
  if (f == Fate::done_and_dies) die();
  return result;
}

/// A write of `count` bytes at a place. @param call writes so many of them
template <class Call>
ssize_t write_by(int fd, off_t at, size_t count, Call call) {
  if (!plan().meant) return call(count);
  const std::lock_guard lock(plan().mutex);
  const std::string path = path_of(fd);
  const Fate f = fate("write", path);
  if (f == Fate::fails) return -1;
  if (path.rfind(plan().folder, 0) == 0) remember_bytes(path, at, count);
  const bool in_part = f == Fate::half_and_on || f == Fate::half_and_dies;
  const ssize_t done = call(in_part && count > 1 ? count / 2 : count);
  if (f == Fate::half_and_dies || f == Fate::done_and_dies) die();
  return done;
}

template <class Call>
int open_by(const char* path, int flags, Call call) {
  if (!plan().meant || (flags & O_ACCMODE) == O_RDONLY) return call();
  const std::string name = absolute(path);
  return whole("open", name, [&] {
    const off_t size = size_of(name);
    const bool counts = plan().loses && name.rfind(plan().folder, 0) == 0;
    if (counts && size >= 0 && (flags & O_TRUNC)) remember_bytes(name, 0, static_cast<size_t>(size));
    const int fd = call();
    if (counts && size < 0 && fd >= 0) plan().unsynced.push_back({Unsynced::What::made, name, "", 0, 0, "", false, 0, {}});
    return fd;
  });
}

int mode_of(int flags, va_list rest) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, int) : 0; }

/// Calls for memory. It asks for none itself.
struct Memory {
  std::atomic<int> state{0};  ///< 1: calls do not count, 2: they do
  std::atomic<long> calls{0};
  long at = 0;
  bool sticky = false;
};
Memory memory;

/// Whether this call for memory gives none.
bool memory_is_out() {
  if (memory.state == 0) {
    memory.state = 1;  // what is called here may ask for memory
    memory.at = std::atol(said("FAULT_AT"));
    memory.sticky = std::strstr(said("FAULT_KIND"), sticky_word);
    if (std::strncmp(said("FAULT_KIND"), "memory", 6) == 0 && is_meant()) memory.state = 2;
  }
  if (memory.state == 1) return false;
  const long now = ++memory.calls;
  if (memory.at == 0 || (now != memory.at && !(memory.sticky && now > memory.at))) return false;
  errno = ENOMEM;
  return true;
}

/// Seconds by which the date is wrong at this look, up to ten years either way; 0 as long as it does not jump.
time_t jump() {
  if (memory.state == 0 || !plan().jumps) return 0;
  plan().seed = static_cast<long>(static_cast<unsigned long>(plan().seed) * 6364136223846793005UL + 1442695040888963407UL);
  return static_cast<time_t>(plan().seed >> 33) % 300000000;
}

/// What was counted, one line, where nothing was to fail.
[[gnu::destructor]] void tell_calls() {
  if (memory.state != 2 || memory.at != 0) return;
  memory.state = 1;
  plan().calls = memory.calls;
  note("memory", "");
}

}  // namespace

extern "C" {

/// Takes a new plan from the environment: for a program that forks a child a trial.
void fault_seam_begins() {
  made_plan() = new Plan;
  memory.state = 0;
  memory.calls = 0;
}

int clock_gettime(clockid_t clock, timespec* now) {
  NEXT(clock_gettime);
  const int result = next(clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += jump();
  return result;
}

time_t time(time_t* place) {
  timespec now{};
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &now);
  now.tv_sec += jump();
  if (place) *place = now.tv_sec;
  return now.tv_sec;
}

void* malloc(size_t n) { return memory_is_out() ? nullptr : __libc_malloc(n); }
void* calloc(size_t n, size_t each) { return memory_is_out() ? nullptr : __libc_calloc(n, each); }
void* realloc(void* old, size_t n) { return memory_is_out() ? nullptr : __libc_realloc(old, n); }

ssize_t write(int fd, const void* data, size_t n) {
  NEXT(write);
  return write_by(fd, static_cast<off_t>(syscall(SYS_lseek, fd, 0, SEEK_CUR)), n,
                  [&](size_t some) { return next(fd, data, some); });
}

ssize_t pwrite(int fd, const void* data, size_t n, off_t at) {
  NEXT(pwrite);
  return write_by(fd, at, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t pwrite64(int fd, const void* data, size_t n, off64_t at) {
  NEXT(pwrite64);
  return write_by(fd, at, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t writev(int fd, const iovec* parts, int n) {
  NEXT(write);
  std::string all;
  for (int k = 0; k < n; ++k) all.append(static_cast<const char*>(parts[k].iov_base), parts[k].iov_len);
  return write_by(fd, static_cast<off_t>(syscall(SYS_lseek, fd, 0, SEEK_CUR)), all.size(),
                  [&](size_t some) { return next(fd, all.data(), some); });
}

int ftruncate(int fd, off_t size) {
  NEXT(ftruncate);
  if (!plan().meant) return next(fd, size);
  const std::string path = path_of(fd);
  return whole("cut", path, [&] {
    const off_t before = size_of(path);
    if (before > size)
      remember_bytes(path, size, static_cast<size_t>(before - size));
    else
      remember_bytes(path, before, 0);
    return next(fd, size);
  });
}

int ftruncate64(int fd, off64_t size) { return ftruncate(fd, size); }

int fsync(int fd) {
  NEXT(fsync);
  if (!plan().meant) return next(fd);
  const std::string path = path_of(fd);
  return whole("fsync", path, [&] {
    made_durable(path);
    return 0;  // the disk itself is not what is tested, and is slow
  });
}

int fdatasync(int fd) { return fsync(fd); }

int rename(const char* from, const char* to) {
  NEXT(rename);
  if (!plan().meant) return next(from, to);
  const std::string old_name = absolute(from), name = absolute(to);
  return whole("rename", name, [&] {
    const off_t size = size_of(name);
    Unsynced u{Unsynced::What::renamed,
               name,
               old_name,
               0,
               size,
               plan().loses && size > 0 ? bytes_at(name, 0, static_cast<size_t>(size)) : "",
               size >= 0,
               ++plan().renames,
               {}};
    const int result = next(from, to);
    if (!plan().loses || result != 0) return result;
    for (Unsynced& earlier : plan().unsynced) {
      if (earlier.path != old_name) continue;
      earlier.former.emplace_back(u.rename, old_name);
      earlier.path = name;
    }
    plan().unsynced.push_back(std::move(u));
    return result;
  });
}

int open(const char* path, int flags, ...) {
  NEXT(open);
  va_list rest;
  va_start(rest, flags);
  const int mode = mode_of(flags, rest);
  va_end(rest);
  return open_by(path, flags, [&] { return next(path, flags, mode); });
}

int open64(const char* path, int flags, ...) {
  NEXT(open64);
  va_list rest;
  va_start(rest, flags);
  const int mode = mode_of(flags, rest);
  va_end(rest);
  return open_by(path, flags, [&] { return next(path, flags, mode); });
}

FILE* fopen(const char* path, const char* how) {
  NEXT(fopen);
  FILE* file = nullptr;
  const int flags = *how == 'r' ? O_RDONLY : *how == 'w' ? O_WRONLY | O_TRUNC : O_WRONLY;
  return open_by(path, flags, [&] { return (file = next(path, how)) ? 0 : -1; }) == 0 ? file : nullptr;
}

FILE* fopen64(const char* path, const char* how) { return fopen(path, how); }
}
