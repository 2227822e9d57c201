// SPDX-License-Identifier: BSD-3-Clause
#include "core/confined_copy.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <new>
#include <system_error>

#include "core/children.hpp"

namespace tripoint {
namespace {

/// Exit codes of the copy. Any other exit code (for example a sanitizer's) counts as a crash.
enum Code { done = 81, refusal = 82, memory_is_short = 83, cannot_confine = 84 };

/// The copy's descriptor of the bytes that it hands back; it has no other above 2
constexpr int to_us = 3;
constexpr std::size_t most_letters = 4096;  ///< of each part of a refusal

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Its shadow alone takes terabytes of address space, and it has something to say
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

/// An open file that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

/// System calls that a reader needs. All others fail with EPERM, as if the user lacked the right.
constexpr std::array free_calls{SCMP_SYS(read),
                                SCMP_SYS(pread64),
                                SCMP_SYS(readv),
                                SCMP_SYS(lseek),
                                SCMP_SYS(close),
                                SCMP_SYS(stat),
                                SCMP_SYS(fstat),
                                SCMP_SYS(lstat),
                                SCMP_SYS(newfstatat),
                                SCMP_SYS(statx),
                                SCMP_SYS(access),
                                SCMP_SYS(faccessat),
                                SCMP_SYS(faccessat2),
                                SCMP_SYS(readlink),
                                SCMP_SYS(readlinkat),
                                SCMP_SYS(getcwd),
                                SCMP_SYS(getdents64),
                                SCMP_SYS(brk),
                                SCMP_SYS(mremap),
                                SCMP_SYS(munmap),
                                SCMP_SYS(madvise),
                                SCMP_SYS(futex),
                                SCMP_SYS(sched_yield),
                                SCMP_SYS(rt_sigaction),
                                SCMP_SYS(rt_sigprocmask),
                                SCMP_SYS(rt_sigreturn),
                                SCMP_SYS(sigaltstack),
                                SCMP_SYS(getrandom),
                                SCMP_SYS(getpid),
                                SCMP_SYS(gettid),
                                SCMP_SYS(getrusage),
                                SCMP_SYS(sysinfo),
                                SCMP_SYS(uname),
                                SCMP_SYS(gettimeofday),
                                SCMP_SYS(clock_gettime),
                                SCMP_SYS(pause),
                                SCMP_SYS(clock_nanosleep),
                                SCMP_SYS(exit),
                                SCMP_SYS(exit_group),
                                SCMP_SYS(getuid),
                                SCMP_SYS(geteuid),
                                SCMP_SYS(sched_getaffinity)};

/// Rule for the n-th word of a call. @param a value, or a mask @param b value of the bits that the mask
/// leaves
scmp_arg_cmp word(unsigned n, scmp_compare how, scmp_datum_t a, scmp_datum_t b = 0) {
  scmp_arg_cmp rule{};
  rule.arg = n;
  rule.op = how;
  rule.datum_a = a;
  rule.datum_b = b;
  return rule;
}

/// A filter of calls that is made rule by rule.
class Filter {
 public:
  Filter() : filter_(seccomp_init(SCMP_ACT_ERRNO(EPERM))), good_(filter_ != nullptr) {}
  ~Filter() {
    if (filter_) seccomp_release(filter_);
  }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;
  void allow(int call, std::initializer_list<scmp_arg_cmp> where = {}) {
    const int error = good_ ? seccomp_rule_add_array(filter_, SCMP_ACT_ALLOW, call,
                                                     static_cast<unsigned>(where.size()), where.begin())
                            : 0;
    // -EDOM: a call that this processor's system does not have
    good_ = good_ && (error == 0 || error == -EDOM);
  }
  [[nodiscard]] bool load() { return good_ && seccomp_load(filter_) == 0; }

 private:
  scmp_filter_ctx filter_;
  bool good_;
};

/// Whether the kernel supports seccomp filters. Valgrind does not, and its own system calls would be
/// filtered.
bool has_filters() {
  std::uint32_t action = SECCOMP_RET_ERRNO;
  return ::syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}

/// From here on this process computes, and writes to `to_us` alone. @returns false where the system has no
/// seccomp
bool filter_calls(bool may_open) {
  if (!has_filters()) return false;
  Filter filter;
  for (const int call : free_calls) filter.allow(call);
  if (may_open) {
    constexpr scmp_datum_t changes = O_ACCMODE | O_CREAT | O_TRUNC | (O_TMPFILE & ~O_DIRECTORY);
    filter.allow(SCMP_SYS(openat), {word(2, SCMP_CMP_MASKED_EQ, changes, O_RDONLY)});
    filter.allow(SCMP_SYS(open), {word(1, SCMP_CMP_MASKED_EQ, changes, O_RDONLY)});
    for (const scmp_datum_t lock : {LOCK_SH, LOCK_SH | LOCK_NB, LOCK_UN})
      filter.allow(SCMP_SYS(flock), {word(1, SCMP_CMP_EQ, lock)});
  }
  // No other: fcntl can ask for signals to any process
  for (const scmp_datum_t what : {F_GETFD, F_SETFD, F_GETFL})
    filter.allow(SCMP_SYS(fcntl), {word(1, SCMP_CMP_EQ, what)});
  filter.allow(SCMP_SYS(setitimer), {word(0, SCMP_CMP_EQ, ITIMER_PROF)});
  filter.allow(SCMP_SYS(write), {word(0, SCMP_CMP_LE, to_us)});
  filter.allow(SCMP_SYS(mmap), {word(2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)});
  filter.allow(SCMP_SYS(mprotect), {word(2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)});
  // Asked, not set
  filter.allow(SCMP_SYS(prlimit64), {word(2, SCMP_CMP_EQ, 0)});
  filter.allow(SCMP_SYS(tgkill), {word(0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()))});  // abort()
  return filter.load();
}

/// From here on the files below a folder are all that this process may open. @returns false where the system
/// has no Landlock
bool see_one_folder(const std::string& folder) {
  landlock_ruleset_attr rules{};
  rules.handled_access_fs = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR |
                            LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE;
  const Descriptor set(static_cast<int>(::syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0)));
  const Descriptor place(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (set.get() < 0 || place.get() < 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  landlock_path_beneath_attr below{};
  below.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
  below.parent_fd = place.get();
  return ::syscall(SYS_landlock_add_rule, set.get(), LANDLOCK_RULE_PATH_BENEATH, &below, 0) == 0 &&
         ::syscall(SYS_landlock_restrict_self, set.get(), 0) == 0;
}

/// Ends this process by SIGPROF after so much of its processor time; 0 takes that back. @param part of a
/// second [us]
void end_after(suseconds_t part) {
  const itimerval time{{0, 0}, {0, part}};
  ::setitimer(ITIMER_PROF, &time, nullptr);
}

/// @returns false where the system cannot
bool confine(const CopyBounds& bounds) {
  // It takes 500 us; libseccomp 2.5 never ends where it has no memory
  constexpr suseconds_t longest = 500'000;
  const bool may_open = !bounds.folder.empty();
  const bool sees_one = !may_open || see_one_folder(bounds.folder);
  end_after(longest);
  const bool filtered = filter_calls(may_open);
  end_after(0);
  return filtered && sees_one;
}

/// The copy keeps none of our files but the one that it hands bytes back by; its words go nowhere.
void let_go_of_our_files(int file) {
  if (file != to_us) ::dup2(file, to_us);
  ::close_range(to_us + 1, ~0U, 0);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) {
    if (is_sanitized && stream == 2) continue;
    if (nothing >= 0)
      ::dup2(nothing, stream);
    else
      ::close(stream);
  }
  if (nothing > 2) ::close(nothing);
}

/// Address space that this process has [bytes]; 0 where the system does not tell.
[[maybe_unused]] rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// @param space that it may have, ours among it [bytes]
void bound(const CopyBounds& bounds, rlim_t space) {
  const auto seconds = static_cast<rlim_t>(std::ceil(bounds.wall_limit)) + 1;
  const rlimit no_core{0, 0}, memory{space, space},
      handed{bounds.most_bytes + 3 * most_letters, RLIM_INFINITY}, cpu{seconds, seconds};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_FSIZE, &handed);
  ::setrlimit(RLIMIT_CPU, &cpu);
  if (!is_sanitized) ::setrlimit(RLIMIT_AS, &memory);
  ::signal(SIGXFSZ, SIG_IGN);  // a write fails then, and says so
}

/// A copy whose parent has ended reads for nobody.
void end_with(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(cannot_confine);
}

bool hand_over_bytes(const std::string& bytes) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t n = ::write(to_us, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += static_cast<std::size_t>(n);
  }
  return true;
}

/// Words of an error without its place, which stands before them.
std::string bare_words(const InputError& e) {
  const std::string words = e.what(), place = to_string(e.place()) + ": ";
  return !e.place().file.empty() && words.starts_with(place) ? words.substr(place.size()) : words;
}

/// "line column letters\n", the file, which has so many letters, and the words.
std::string refusal_text(const SourcePlace& place, const std::string& words) {
  const std::string file = place.file.substr(0, most_letters);
  return fmt::format("{} {} {}\n{}{}", place.line, place.column, file.size(), file,
                     words.substr(0, most_letters));
}

/// @throws std::bad_alloc
int read_and_hand_over(const std::function<std::string()>& read) {
  try {
    return hand_over_bytes(read()) ? done : memory_is_short;
  } catch (const std::bad_alloc&) {
    return memory_is_short;
  } catch (const InputError& e) {
    return hand_over_bytes(refusal_text(e.place(), bare_words(e))) ? refusal : memory_is_short;
  } catch (const std::exception& e) {
    return hand_over_bytes(refusal_text({}, e.what())) ? refusal : memory_is_short;
  }
}

/// Values that are taken before the fork, where they can still be asked for.
struct Start {
  pid_t parent = ::getpid();
  rlim_t space = address_space();
};

[[noreturn, maybe_unused]] void be_the_copy(const std::function<std::string()>& read,
                                            const CopyBounds& bounds, const Start& start, int file) {
  end_with(start.parent);
  let_go_of_our_files(file);
  bound(bounds, start.space + bounds.memory);
  if (!confine(bounds) && bounds.must_be_confined) ::_exit(cannot_confine);
  int code = memory_is_short;
  try {
    code = read_and_hand_over(read);
  } catch (...) {  // no memory even for the words of a refusal
  }
  ::_exit(code);
}

#if defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
CopyEnd read_here(const std::function<std::string()>& read) {
  try {
    return {CopyEnd::How::read, 0, read(), {}};
  } catch (const InputError& e) {
    return {CopyEnd::How::refused, 0, bare_words(e), e.place()};
  } catch (const std::exception& e) {
    return {CopyEnd::How::refused, 0, e.what(), {}};
  }
}
#endif

/// All bytes of a file in memory that nobody writes any more. @throws std::system_error EFBIG where there are
/// too many
std::string bytes_of(int file, rlim_t most) {
  struct stat info {};
  if (::fstat(file, &info) != 0)
    throw std::system_error(errno, std::generic_category(), "what a copy handed back");
  if (static_cast<rlim_t>(info.st_size) > most)
    throw std::system_error(EFBIG, std::generic_category(), "what a copy handed back");
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t n = ::pread(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw std::system_error(n < 0 ? errno : EIO, std::generic_category(), "what a copy handed back");
    at += static_cast<std::size_t>(n);
  }
  return bytes;
}

/// Reads the bytes that refusal_text() made. Any other bytes, which a hijacked copy could hand back, are
/// taken as words.
void take_refusal(CopyEnd& end) {
  end.how = CopyEnd::How::refused;
  const std::string bytes = end.bytes.substr(0, 3 * most_letters);
  std::size_t letters = 0;
  const auto start = bytes.find('\n') + 1;  // 0 where there is none
  if (std::sscanf(bytes.c_str(), "%d %d %zu", &end.place.line, &end.place.column, &letters) == 3 &&
      start > 0 && letters <= bytes.size() - start) {
    end.place.file = bytes.substr(start, letters);
    end.bytes = bytes.substr(start + letters);
  }
}

[[maybe_unused]] CopyEnd end_of(const ChildEnd& child, const CopyBounds& bounds, int file) {
  using How = CopyEnd::How;
  CopyEnd end;
  if (!child.in_time) {
    end.how = How::late;
    return end;
  }
  if (!WIFEXITED(child.status)) {
    end.code = WTERMSIG(child.status);
    end.how = end.code == SIGXCPU ? How::late : end.code == SIGPROF ? How::no_memory : How::killed;
    return end;
  }
  switch (WEXITSTATUS(child.status)) {
    case done:
      end.bytes = bytes_of(file, bounds.most_bytes);
      break;
    case refusal:
      end.bytes = bytes_of(file, 3 * most_letters + bounds.most_bytes);
      take_refusal(end);
      break;
    case memory_is_short:
      end.how = How::no_memory;
      break;
    case cannot_confine:
      end.how = How::not_confined;
      break;
    default:
      end.how = How::killed;
  }
  return end;
}

}  // namespace

rlim_t machine_memory() {
  return static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

CopyEnd read_in_confined_copy(const std::function<std::string()>& read,
                              [[maybe_unused]] const CopyBounds& bounds) {
#if defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  return read_here(read);  // a process for each input would leave a fuzzer no inputs
#else
  const Descriptor handed(::memfd_create("tripoint-read", MFD_CLOEXEC));
  if (handed.get() < 0)
    throw std::system_error(errno, std::generic_category(),
                            bounds.what + " was not read: no file is to spare for what a copy of us reads");
  keep_ends_of_children();
  const Start start;
  const pid_t child = ::fork();
  const int error = errno;
  if (child < 0)
    throw std::system_error(error, std::generic_category(),
                            bounds.what + " was not read: there is no process to spare to read it in");
  if (child == 0) be_the_copy(read, bounds, start, handed.get());
  return end_of(end_of_child(child, bounds.wall_limit), bounds, handed.get());
#endif
}

void rethrow(const CopyEnd& end) {
  if (end.how == CopyEnd::How::refused) throw InputError(end.place, end.bytes);
}

std::string failure_of(const CopyEnd& end, const CopyBounds& bounds) {
  const std::string& what = bounds.what;
  using How = CopyEnd::How;
  switch (end.how) {
    case How::read:
    case How::refused:
      return {};
    case How::killed:
      return end.code == 0 ? what + " ends the program that reads it"
                           : fmt::format("{} kills the library that reads it (signal {}, {})", what, end.code,
                                         ::strsignal(end.code));
    case How::late:
      return fmt::format("{} could not be read within {:g} s", what, bounds.wall_limit);
    case How::no_memory:
      return what + " takes more memory than this machine has";
    case How::not_confined:
      return what +
             " was not read: this system cannot confine its reader (seccomp; for trajectories Landlock too)";
  }
  return {};
}

}  // namespace tripoint
