// SPDX-License-Identifier: BSD-3-Clause
// Stands between a program and the C library (LD_PRELOAD), and lets some of its calls fail: the n-th of a set
// of calls, as those that change a file below a folder, or the n-th that asks for memory. Programs are tested
// as they are shipped; nothing of this is in them.
//
//   FAULT_PROCESS   beginning of the name of the process that is meant; others are left alone. Copies that it
//   forks are meant too FAULT_FOLDER    calls on files below it count FAULT_AT        which call fails, from
//   1; 0 = none, calls are counted only. Several: "7,30", each with its kind FAULT_KIND      the name of a
//   set and a hyphen before what happens. Without them the set is that of calls that change a file
//                   (open, write, cut, fsync, rename). The others: name (a file or folder is removed, a
//                   folder made), read (a file is opened for reading or read), stream (a pipe is read), and
//                   of children fork, spawn, pipe, poll, pidfd, wait, kill, limit. What happens: a word for
//                   an error (eio, enospc, eintr, ...): the call fails so; short: half of it is done, as may
//                   be; before, half, after: the process is killed before the call, half way through it,
//                   after it; lost: it is killed, and what no fsync has made durable is undone, but for a
//                   beginning whose length FAULT_SEED draws; clock: from then on the date jumps by years at
//                   every look; memory: the n-th call for memory gives none. With "+sticky" all later calls
//                   of the set fail too
//   FAULT_LOG       a line a call that counts, or the one that failed: number, operation, path. Of calls for
//   memory: their number
//                   at the end, and of the one that failed its number and the name of its stack
//   FAULT_STACKS    how many callers make a stack of calls. Of calls for memory that are counted there is a
//   line for each stack:
//                   number of its first, of its last, name
#include "faults/seam.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

namespace fault_seam {

const char* said(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Whether this is the process that is meant. No memory is asked for.
bool is_meant() {
  const char* process = said("FAULT_PROCESS");
  char name[64] = "";
  const int f = static_cast<int>(raw(SYS_openat, AT_FDCWD, "/proc/self/comm", O_RDONLY | O_CLOEXEC));
  if (f < 0) return false;
  const long n = raw(SYS_read, f, name, sizeof name - 1);
  raw(SYS_close, f);
  return *process && n > 0 && std::strncmp(name, process, std::strlen(process)) == 0;
}

[[noreturn]] void die() {
  raw(SYS_kill, getpid(), SIGKILL);
  for (;;) pause();
}

namespace {

Set set_of(std::string_view name) {
  const auto at = std::ranges::find(set_names, name);
  return at == set_names.end() ? Set::files : static_cast<Set>(at - set_names.begin());
}

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

}  // namespace

std::vector<Fault> faults_asked() {
  const std::vector<std::string> places = parts_of(said("FAULT_AT")), kinds = parts_of(said("FAULT_KIND"));
  std::vector<Fault> faults;
  for (size_t n = 0; n < places.size() && n < kinds.size(); ++n) {
    const std::string kind = kinds[n].substr(0, kinds[n].find(sticky_word));
    const size_t hyphen = kind.find('-');
    faults.push_back({std::atol(places[n].c_str()), set_of(kind.substr(0, hyphen)),
                      hyphen == std::string::npos ? kind : kind.substr(hyphen + 1),
                      kind.size() < kinds[n].size()});
  }
  return faults;
}

/// Copies that a process forks count on with it, so that no two calls have one number.
Counters& shared_counters() {
  void* const memory =
      mmap(nullptr, sizeof(Counters), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return *new (memory) Counters{};
}

bool is_about_memory() { return std::strncmp(said("FAULT_KIND"), "memory", 6) == 0; }

bool any_loses(const std::vector<Fault>& faults) {
  return std::ranges::any_of(faults, [](const Fault& f) { return f.kind == "lost"; });
}

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

namespace {

void note(long number, const char* operation, const std::string& path) {
  if (plan().log.empty()) return;
  const std::string line = std::to_string(number) + " " + operation + " " + path + "\n";
  const int f = static_cast<int>(
      raw(SYS_openat, AT_FDCWD, plan().log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (f < 0) return;
  raw(SYS_write, f, line.data(), line.size());
  raw(SYS_close, f);
}

}  // namespace

std::string bytes_at(const std::string& path, off_t at, size_t count) {
  std::string bytes(count, '\0');
  const int f = static_cast<int>(raw(SYS_openat, AT_FDCWD, path.c_str(), O_RDONLY | O_CLOEXEC));
  const long n = f >= 0 ? raw(SYS_pread64, f, bytes.data(), count, at) : 0;
  if (f >= 0) raw(SYS_close, f);
  bytes.resize(n > 0 ? static_cast<size_t>(n) : 0);
  return bytes;
}

off_t size_of(const std::string& path) {
  struct stat about {};
  return stat(path.c_str(), &about) == 0 ? about.st_size : -1;
}

namespace {

void undo(const Unsynced& u) {
  if (u.what == Unsynced::What::made) {
    if (raw(SYS_unlinkat, AT_FDCWD, u.path.c_str(), 0) != 0)
      raw(SYS_unlinkat, AT_FDCWD, u.path.c_str(), AT_REMOVEDIR);
    return;
  }
  if (u.what == Unsynced::What::removed && u.existed) {
    raw(SYS_mkdirat, AT_FDCWD, u.path.c_str(), 0755);
    return;
  }
  if (u.what == Unsynced::What::renamed)
    raw(SYS_renameat, AT_FDCWD, u.path.c_str(), AT_FDCWD, u.old_path.c_str());
  if (u.what == Unsynced::What::renamed && !u.existed) return;
  const int f =
      static_cast<int>(raw(SYS_openat, AT_FDCWD, u.path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (f < 0) return;
  raw(SYS_pwrite64, f, u.bytes.data(), u.bytes.size(), u.at);
  raw(SYS_ftruncate, f, u.size);
  raw(SYS_close, f);
}

/// What a rename that is undone had moved has its former name again: else the making of a file that took
/// another's place would be undone on that other one.
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

}  // namespace

void remember_bytes(const std::string& path, off_t at, size_t count) {
  if (!plan().loses) return;
  plan().unsynced.push_back(
      {Unsynced::What::bytes, path, "", at, size_of(path), bytes_at(path, at, count), true, 0, {}});
}

void remember_made(const std::string& path) {
  plan().unsynced.push_back({Unsynced::What::made, path, "", 0, 0, "", false, 0, {}});
}

void made_durable(const std::string& path) {
  std::erase_if(plan().unsynced, [&](const Unsynced& u) {
    return u.what == Unsynced::What::bytes ? u.path == path : folder_of(u.path) == path;
  });
}

namespace {

int error_named(const std::string& name) {
  static const std::pair<const char*, int> errors[] = {
      {"eio", EIO},       {"enospc", ENOSPC}, {"erofs", EROFS},   {"edquot", EDQUOT},
      {"eintr", EINTR},   {"eacces", EACCES}, {"eagain", EAGAIN}, {"enomem", ENOMEM},
      {"emfile", EMFILE}, {"echild", ECHILD}, {"eperm", EPERM},   {"enosys", ENOSYS}};
  for (const auto& [word, error] : errors)
    if (name == word) return error;
  return EIO;
}

/// Whether such a call may be cut short or interrupted: of files on a disk only reading and writing them.
bool may_stop_half_way(Set set, const char* operation) {
  return set > Set::stream || std::strcmp(operation, "write") == 0 || std::strcmp(operation, "read") == 0;
}

/// What a fault of that kind does to such a call.
Fate fate_of(const Fault& fault, const char* operation) {
  const std::string& kind = fault.kind;
  if (kind == "clock") plan().jumps = true;
  if (kind == "clock") return Fate::passes;
  if ((kind == "eintr" || kind == "short") && !may_stop_half_way(fault.set, operation)) return Fate::passes;
  if (kind == "lost") lose();
  if (kind == "lost" || kind == "before") die();
  if (kind == "half") return Fate::half_and_dies;
  if (kind == "after") return Fate::done_and_dies;
  if (kind == "short") return Fate::half_and_on;
  errno = error_named(kind);
  return Fate::fails;
}

/// Whether a call on this counts. Calls about children have no path.
bool is_counted(Set set, const std::string& path) {
  if (set > Set::stream) return true;
  if (set == Set::stream) return path.starts_with("pipe:") || path.starts_with("socket:");
  return !plan().folder.empty() && path.starts_with(plan().folder);
}

}  // namespace

Fate fate(Set set, const char* operation, const std::string& path) {
  Plan& p = plan();
  if (!p.meant || !is_counted(set, path)) return Fate::passes;
  const long now = ++p.calls[static_cast<size_t>(set)];
  if (p.counts_only && p.faults[0].set == set) note(now, operation, path);
  for (const Fault& f : p.faults) {
    if (f.set != set || f.at == 0 || now < f.at || (now > f.at && !f.sticky)) continue;
    if (now == f.at) note(now, operation, path);
    if (const Fate found = fate_of(f, operation); found != Fate::passes) return found;
  }
  return Fate::passes;
}

}  // namespace fault_seam
