// SPDX-License-Identifier: BSD-3-Clause
// Stands between a program and the C library (LD_PRELOAD), and lets some of its calls fail: the n-th of a set of calls, as those
// that change a file below a folder, or the n-th that asks for memory. Programs are tested as they are shipped; nothing of this
// is in them.
//
//   FAULT_PROCESS   beginning of the name of the process that is meant; others are left alone. Copies that it forks are meant too
//   FAULT_FOLDER    calls on files below it count
//   FAULT_AT        which call fails, from 1; 0 = none, calls are counted only. Several: "7,30", each with its kind
//   FAULT_KIND      the name of a set and a hyphen before what happens. Without them the set is that of calls that change a file
//                   (open, write, cut, fsync, rename). The others: name (a file or folder is removed, a folder made), read (a
//                   file is opened for reading or read), stream (a pipe is read), and of children fork, spawn, pipe, poll, pidfd,
//                   wait, kill, limit. What happens:
//                   a word for an error (eio, enospc, eintr, ...): the call fails so; short: half of it is done, as may be;
//                   before, half, after: the process is killed before the call, half way through it, after it;
//                   lost: it is killed, and what no fsync has made durable is undone, but for a beginning whose length FAULT_SEED
//                   draws; clock: from then on the date jumps by years at every look; memory: the n-th call for memory gives
//                   none. With "+sticky" all later calls of the set fail too
//   FAULT_LOG       a line a call that counts, or the one that failed: number, operation, path. Of calls for memory: their number
//                   at the end, and of the one that failed its number and the name of its stack
//   FAULT_STACKS    how many callers make a stack of calls. Of calls for memory that are counted there is a line for each stack:
//                   number of its first, of its last, name
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern "C" void* __libc_malloc(size_t);
extern "C" void* __libc_calloc(size_t, size_t);
extern "C" void* __libc_realloc(void*, size_t);
extern "C" void* __libc_memalign(size_t, size_t);

namespace {

#define NEXT(name) static auto* const next = reinterpret_cast<decltype(&(name))>(dlsym(RTLD_NEXT, #name))

/// A call of the system that passes by what stands here.
template <class... Words>
long raw(long number, Words... words) {
  static long (*next)(long, ...);  // without a guard: the first call may come from within its own making
  if (!next) next = reinterpret_cast<long (*)(long, ...)>(dlsym(RTLD_NEXT, "syscall"));
  return next(number, words...);
}

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

/// What a loss of power would undo: a file or folder that came to be, bytes that were written or cut off, another name, a file or
/// folder that went.
struct Unsynced {
  enum class What { made, bytes, renamed, removed } what;
  std::string path, old_path;                        ///< old_path: of a renamed file
  off_t at = 0, size = 0;                            ///< where bytes were written; size of the file before
  std::string bytes;                                 ///< that were there
  bool existed = false;                              ///< what a renamed file replaced; of what was removed: a folder
  long rename = 0;                                   ///< number of this change, where it is a rename
  std::vector<std::pair<long, std::string>> former;  ///< renames that moved the file since, each with the name that it had before
};

constexpr const char* sticky_word = "+sticky";

/// Calls of one set are counted together.
enum class Set : size_t { files, name, read, stream, fork, spawn, pipe, poll, pidfd, wait, kill, limit };
constexpr std::array<std::string_view, 12> set_names{"files", "name", "read",  "stream", "fork", "spawn",
                                                     "pipe",  "poll", "pidfd", "wait",   "kill", "limit"};

Set set_of(std::string_view name) {
  const auto at = std::ranges::find(set_names, name);
  return at == set_names.end() ? Set::files : static_cast<Set>(at - set_names.begin());
}

/// One call that fails, or all from it on.
struct Fault {
  long at = 0;
  Set set = Set::files;
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
    const std::string kind = kinds[n].substr(0, kinds[n].find(sticky_word));
    const size_t hyphen = kind.find('-');
    faults.push_back({std::atol(places[n].c_str()), set_of(kind.substr(0, hyphen)),
                      hyphen == std::string::npos ? kind : kind.substr(hyphen + 1), kind.size() < kinds[n].size()});
  }
  return faults;
}

using Counters = std::array<std::atomic<long>, set_names.size()>;

/// Copies that a process forks count on with it, so that no two calls have one number.
Counters& shared_counters() {
  void* const memory = mmap(nullptr, sizeof(Counters), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return *new (memory) Counters{};
}

bool is_about_memory() { return std::strncmp(said("FAULT_KIND"), "memory", 6) == 0; }

struct Plan {
  std::vector<Fault> faults = faults_asked();
  long seed = std::atol(said("FAULT_SEED"));
  std::string folder = said("FAULT_FOLDER"), log = said("FAULT_LOG");
  bool meant = is_meant() && !is_about_memory();  ///< where memory is meant, this file asks for none on the program's account
  bool counts_only = faults.size() == 1 && faults[0].at == 0;
  bool loses = std::ranges::any_of(faults, [](const Fault& f) { return f.kind == "lost"; });
  bool jumps = false;  ///< the date does
  Counters& calls = shared_counters();
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

void note(long number, const char* operation, const std::string& path) {
  if (plan().log.empty()) return;
  const std::string line = std::to_string(number) + " " + operation + " " + path + "\n";
  const int f = static_cast<int>(raw(SYS_openat, AT_FDCWD, plan().log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (f < 0) return;
  raw(SYS_write, f, line.data(), line.size());
  raw(SYS_close, f);
}

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

void undo(const Unsynced& u) {
  if (u.what == Unsynced::What::made) {
    if (raw(SYS_unlinkat, AT_FDCWD, u.path.c_str(), 0) != 0) raw(SYS_unlinkat, AT_FDCWD, u.path.c_str(), AT_REMOVEDIR);
    return;
  }
  if (u.what == Unsynced::What::removed && u.existed) {
    raw(SYS_mkdirat, AT_FDCWD, u.path.c_str(), 0755);
    return;
  }
  if (u.what == Unsynced::What::renamed) raw(SYS_renameat, AT_FDCWD, u.path.c_str(), AT_FDCWD, u.old_path.c_str());
  if (u.what == Unsynced::What::renamed && !u.existed) return;
  const int f = static_cast<int>(raw(SYS_openat, AT_FDCWD, u.path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (f < 0) return;
  raw(SYS_pwrite64, f, u.bytes.data(), u.bytes.size(), u.at);
  raw(SYS_ftruncate, f, u.size);
  raw(SYS_close, f);
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

int error_named(const std::string& name) {
  static const std::pair<const char*, int> errors[] = {
      {"eio", EIO},       {"enospc", ENOSPC}, {"erofs", EROFS},   {"edquot", EDQUOT}, {"eintr", EINTR}, {"eacces", EACCES},
      {"eagain", EAGAIN}, {"enomem", ENOMEM}, {"emfile", EMFILE}, {"echild", ECHILD}, {"eperm", EPERM}, {"enosys", ENOSYS}};
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

/// What becomes of a call. Where it fails, errno says why.
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

/// A call that is done whole or not at all. @param call does it
template <class Call>
auto whole(Set set, const char* operation, const std::string& path, Call call) -> decltype(call()) {
  const std::lock_guard lock(plan().mutex);
  const Fate f = fate(set, operation, path);
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
  const Fate f = fate(Set::files, "write", path);
  if (f == Fate::fails) return -1;
  if (path.starts_with(plan().folder)) remember_bytes(path, at, count);
  const bool in_part = f == Fate::half_and_on || f == Fate::half_and_dies;
  const ssize_t done = call(in_part && count > 1 ? count / 2 : count);
  if (f == Fate::half_and_dies || f == Fate::done_and_dies) die();
  return done;
}

/// A read of up to `count` bytes. It may wait, so that nothing is held meanwhile. @param call reads so many of them
template <class Call>
ssize_t read_by(int fd, size_t count, Call call) {
  if (!plan().meant) return call(count);
  const Fate f = [&] {
    const std::lock_guard lock(plan().mutex);
    const std::string path = path_of(fd);
    return fate(path.starts_with('/') ? Set::read : Set::stream, "read", path);
  }();
  if (f == Fate::fails) return -1;
  if (f == Fate::half_and_dies) die();
  const ssize_t done = call(f == Fate::half_and_on && count > 1 ? count / 2 : count);
  if (f == Fate::done_and_dies) die();
  return done;
}

/// A call about children. It may wait, so that nothing is held meanwhile.
template <class Call>
auto child_by(Set set, const char* operation, Call call) -> decltype(call()) {
  if (!plan().meant) return call();
  const Fate f = [&] {
    const std::lock_guard lock(plan().mutex);
    return fate(set, operation, "");
  }();
  if (f == Fate::fails) return static_cast<decltype(call())>(-1);
  if (f == Fate::half_and_dies) die();
  const auto result = call();
  if (f == Fate::done_and_dies && !(set == Set::fork && result == 0)) die();
  return result;
}

void remember_made(const std::string& path) {
  plan().unsynced.push_back({Unsynced::What::made, path, "", 0, 0, "", false, 0, {}});
}

template <class Call>
int open_by(const char* path, int flags, Call call) {
  if (!plan().meant) return call();
  const std::string name = absolute(path);
  if ((flags & O_ACCMODE) == O_RDONLY) return whole(Set::read, "open", name, call);
  return whole(Set::files, "open", name, [&] {
    const off_t size = size_of(name);
    const bool counts = plan().loses && name.starts_with(plan().folder);
    if (counts && size >= 0 && (flags & O_TRUNC)) remember_bytes(name, 0, static_cast<size_t>(size));
    const int fd = call();
    if (counts && size < 0 && fd >= 0) remember_made(name);
    return fd;
  });
}

/// A file or folder goes.
template <class Call>
int remove_by(const char* operation, const std::string& name, Call call) {
  return whole(Set::name, operation, name, [&] {
    struct stat about {};
    const bool counts = plan().loses && name.starts_with(plan().folder) && lstat(name.c_str(), &about) == 0;
    const bool is_file = S_ISREG(about.st_mode), is_folder = S_ISDIR(about.st_mode);
    std::string bytes = counts && is_file ? bytes_at(name, 0, static_cast<size_t>(about.st_size)) : "";
    const int result = call();
    if (counts && result == 0 && (is_file || is_folder))
      plan().unsynced.push_back({Unsynced::What::removed, name, "", 0, about.st_size, std::move(bytes), is_folder, 0, {}});
    return result;
  });
}

template <class Call>
int make_folder_by(const std::string& name, Call call) {
  return whole(Set::name, "mkdir", name, [&] {
    const int result = call();
    if (plan().loses && result == 0 && name.starts_with(plan().folder)) remember_made(name);
    return result;
  });
}

/// Path of a file that is named from an open folder on.
std::string path_from(int folder, const char* path) {
  return *path == '/' || folder == AT_FDCWD ? absolute(path) : path_of(folder) + "/" + path;
}

int mode_of(int flags, va_list rest) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, int) : 0; }

/// Calls for memory. It asks for none itself.
struct Memory {
  std::atomic<int> state{0};  ///< 1: calls do not count, 2: they do
  std::atomic<long> calls{0};
  long at = 0;
  bool sticky = false;
  size_t callers = 0;  ///< that make a stack
};
Memory memory;

/// From where memory was asked for: its caller, and who called that one.
struct Stack {
  std::array<const void*, 128> frames;
  const void* caller;
  size_t depth = 0;
};

Stack stack_from(const void* caller) {
  Stack stack;
  stack.caller = caller;
  const auto add = [](_Unwind_Context* context, void* place) {
    auto* const to = static_cast<Stack*>(place);
    if (to->depth == std::min(to->frames.size(), memory.callers)) return _URC_END_OF_STACK;
    const auto* const at = reinterpret_cast<const void*>(_Unwind_GetIP(context));
    if (to->depth > 0 || at == to->caller) to->frames[to->depth++] = at;
    return _URC_NO_REASON;
  };
  _Unwind_Backtrace(add, &stack);
  return stack;
}

void mix(unsigned long& hash, unsigned long value) { hash = (hash ^ value) * 1099511628211UL; }

unsigned long hash_of(const Stack& stack) {
  unsigned long hash = 1469598103934665603UL;
  for (size_t n = 0; n < stack.depth; ++n) mix(hash, reinterpret_cast<unsigned long>(stack.frames[n]));
  return hash | 1UL;
}

/// The same in each run, wherever the system has put program and libraries.
unsigned long name_of(const Stack& stack) {
  unsigned long hash = 1469598103934665603UL;
  for (size_t n = 0; n < stack.depth; ++n) {
    Dl_info about{};
    const bool known = dladdr(stack.frames[n], &about) != 0 && about.dli_fname;
    for (const char* c = known ? about.dli_fname : ""; *c; ++c) mix(hash, static_cast<unsigned char>(*c));
    mix(hash,
        reinterpret_cast<unsigned long>(stack.frames[n]) - reinterpret_cast<unsigned long>(known ? about.dli_fbase : nullptr));
  }
  return hash;
}

/// Stacks that were met, each with its first and its last call.
struct Met {
  unsigned long hash, name;
  long first, last;
};
constexpr size_t most_stacks = 1UL << 17;
Met* stacks_met = nullptr;
std::atomic_flag stacks_are_taken;

void meet(long now, const void* caller) {
  const Stack stack = stack_from(caller);
  const unsigned long hash = hash_of(stack);
  while (stacks_are_taken.test_and_set()) continue;
  size_t n = hash % most_stacks;
  for (size_t looks = 0; looks < most_stacks && stacks_met[n].hash != 0 && stacks_met[n].hash != hash; ++looks)
    n = (n + 1) % most_stacks;
  Met& met = stacks_met[n];
  if (met.hash == 0) met = {hash, name_of(stack), now, now};
  if (met.hash == hash) met.last = std::max(met.last, now);
  stacks_are_taken.clear();
}

/// A line to the log, where no memory may be asked for.
void note_line(const char* line, int size) {
  const char* log = said("FAULT_LOG");
  const int f = *log ? static_cast<int>(raw(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) : -1;
  if (f < 0) return;
  raw(SYS_write, f, line, static_cast<size_t>(size));
  raw(SYS_close, f);
}

void begin_memory() {
  memory.state = 1;  // what is called here may ask for memory
  memory.at = std::atol(said("FAULT_AT"));
  memory.sticky = std::strstr(said("FAULT_KIND"), sticky_word);
  if (!is_about_memory() || !is_meant()) return;
  static_cast<void>(plan());
  memory.callers = static_cast<size_t>(std::atol(said("FAULT_STACKS")));
  if (memory.callers > 0 && memory.at == 0)
    stacks_met =
        static_cast<Met*>(mmap(nullptr, most_stacks * sizeof(Met), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  memory.state = 2;
}

/// Whether a call for memory from there gives none.
bool memory_is_out(const void* caller) {
  if (memory.state == 0) begin_memory();
  if (memory.state == 1) return false;
  const long now = ++memory.calls;
  if (stacks_met) meet(now, caller);
  if (memory.at == 0 || (now != memory.at && !(memory.sticky && now > memory.at))) return false;
  if (now == memory.at) {
    char line[64];
    note_line(line, std::snprintf(line, sizeof line, "%ld stack %016lx\n", now, name_of(stack_from(caller))));
  }
  errno = ENOMEM;
  return true;
}

/// Seconds by which the date is wrong at this look, up to ten years either way; 0 as long as it does not jump.
time_t jump() {
  if (memory.state == 0 || !plan().jumps) return 0;
  plan().seed = static_cast<long>(static_cast<unsigned long>(plan().seed) * 6364136223846793005UL + 1442695040888963407UL);
  return static_cast<time_t>(plan().seed >> 33) % 300000000;
}

/// What was counted, where nothing was to fail: the last line has the number of all calls.
[[gnu::destructor]] void tell_calls() {
  if (memory.state != 2 || memory.at != 0) return;
  memory.state = 1;
  char line[96];
  for (size_t n = 0; stacks_met && n < most_stacks; ++n)
    if (const Met& met = stacks_met[n]; met.hash != 0)
      note_line(line, std::snprintf(line, sizeof line, "%ld %ld %016lx\n", met.first, met.last, met.name));
  note_line(line, std::snprintf(line, sizeof line, "%ld memory\n", memory.calls.load()));
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
  raw(SYS_clock_gettime, CLOCK_REALTIME, &now);
  now.tv_sec += jump();
  if (place) *place = now.tv_sec;
  return now.tv_sec;
}

void* malloc(size_t n) { return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_malloc(n); }
void* calloc(size_t n, size_t each) { return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_calloc(n, each); }
void* realloc(void* old, size_t n) { return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_realloc(old, n); }
void* memalign(size_t bound, size_t n) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
}
void* aligned_alloc(size_t bound, size_t n) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
}

int posix_memalign(void** place, size_t bound, size_t n) {
  void* const made = memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
  if (!made) return ENOMEM;
  *place = made;
  return 0;
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

ssize_t read(int fd, void* data, size_t n) {
  NEXT(read);
  return read_by(fd, n, [&](size_t some) { return next(fd, data, some); });
}

ssize_t pread(int fd, void* data, size_t n, off_t at) {
  NEXT(pread);
  return read_by(fd, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t pread64(int fd, void* data, size_t n, off64_t at) { return pread(fd, data, n, at); }

// What a build with _FORTIFY_SOURCE calls instead.
ssize_t __read_chk(int fd, void* data, size_t n, size_t /*most*/) { return read(fd, data, n); }
ssize_t __pread_chk(int fd, void* data, size_t n, off_t at, size_t /*most*/) { return pread(fd, data, n, at); }
ssize_t __pread64_chk(int fd, void* data, size_t n, off64_t at, size_t /*most*/) { return pread(fd, data, n, at); }
int __poll_chk(pollfd* all, nfds_t n, int limit, size_t /*most*/) { return poll(all, n, limit); }
int __open_2(const char* path, int flags) { return open(path, flags); }
int __open64_2(const char* path, int flags) { return open(path, flags); }

ssize_t write(int fd, const void* data, size_t n) {
  NEXT(write);
  return write_by(fd, static_cast<off_t>(raw(SYS_lseek, fd, 0, SEEK_CUR)), n, [&](size_t some) { return next(fd, data, some); });
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
  return write_by(fd, static_cast<off_t>(raw(SYS_lseek, fd, 0, SEEK_CUR)), all.size(),
                  [&](size_t some) { return next(fd, all.data(), some); });
}

int ftruncate(int fd, off_t size) {
  NEXT(ftruncate);
  if (!plan().meant) return next(fd, size);
  const std::string path = path_of(fd);
  return whole(Set::files, "cut", path, [&] {
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
  return whole(Set::files, "fsync", path, [&] {
    made_durable(path);
    return 0;  // the disk itself is not what is tested, and is slow
  });
}

int fdatasync(int fd) { return fsync(fd); }

int rename(const char* from, const char* to) {
  NEXT(rename);
  if (!plan().meant) return next(from, to);
  const std::string old_name = absolute(from), name = absolute(to);
  return whole(Set::files, "rename", name, [&] {
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

int unlink(const char* path) noexcept {
  NEXT(unlink);
  return plan().meant ? remove_by("unlink", absolute(path), [&] { return next(path); }) : next(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  NEXT(unlinkat);
  const auto call = [&] { return next(folder, path, flags); };
  return plan().meant ? remove_by("unlink", path_from(folder, path), call) : call();
}

int rmdir(const char* path) noexcept {
  NEXT(rmdir);
  return plan().meant ? remove_by("rmdir", absolute(path), [&] { return next(path); }) : next(path);
}

int remove(const char* path) noexcept {
  NEXT(remove);
  return plan().meant ? remove_by("remove", absolute(path), [&] { return next(path); }) : next(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  NEXT(mkdir);
  return plan().meant ? make_folder_by(absolute(path), [&] { return next(path, mode); }) : next(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  NEXT(mkdirat);
  const auto call = [&] { return next(folder, path, mode); };
  return plan().meant ? make_folder_by(path_from(folder, path), call) : call();
}

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

int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* actions, const posix_spawnattr_t* attributes,
                char* const* argv, char* const* environment) {
  NEXT(posix_spawn);
  errno = 0;
  const int result = child_by(Set::spawn, "posix_spawn", [&] { return next(pid, path, actions, attributes, argv, environment); });
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
}
