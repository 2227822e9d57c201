// SPDX-License-Identifier: BSD-3-Clause
#include "foreign/confined_copy.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <new>
#include <system_error>

#include "core/children.hpp"

namespace tripoint {
namespace {

enum Code { done = 0, refusal = 1, memory_is_short = 3, cannot_confine = 5 };

constexpr int to_us = 3;  ///< the copy's descriptor of what it hands back; it has no other above 2

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

/// What a reader needs. All else fails with EPERM, as if the user might not do it.
constexpr std::array free_calls{
    SCMP_SYS(read),         SCMP_SYS(pread64),        SCMP_SYS(readv),        SCMP_SYS(lseek),       SCMP_SYS(close),
    SCMP_SYS(stat),         SCMP_SYS(fstat),          SCMP_SYS(lstat),        SCMP_SYS(newfstatat),  SCMP_SYS(statx),
    SCMP_SYS(access),       SCMP_SYS(faccessat),      SCMP_SYS(faccessat2),   SCMP_SYS(readlink),    SCMP_SYS(readlinkat),
    SCMP_SYS(getcwd),       SCMP_SYS(getdents64),     SCMP_SYS(fcntl),        SCMP_SYS(flock),       SCMP_SYS(brk),
    SCMP_SYS(mremap),       SCMP_SYS(munmap),         SCMP_SYS(madvise),      SCMP_SYS(futex),       SCMP_SYS(sched_yield),
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack), SCMP_SYS(getrandom),
    SCMP_SYS(getpid),       SCMP_SYS(gettid),         SCMP_SYS(getrusage),    SCMP_SYS(sysinfo),     SCMP_SYS(uname),
    SCMP_SYS(gettimeofday), SCMP_SYS(clock_gettime),  SCMP_SYS(pause),        SCMP_SYS(ppoll),       SCMP_SYS(clock_nanosleep),
    SCMP_SYS(exit),         SCMP_SYS(exit_group),     SCMP_SYS(getuid),       SCMP_SYS(geteuid),     SCMP_SYS(sched_getaffinity)};

/// From here on this process reads, computes, and writes to `to_us` alone. @returns false where the system has no seccomp
bool confine() {
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (!filter) return false;
  bool good = true;
  const auto allow = [&](int call, std::initializer_list<scmp_arg_cmp> where = {}) {
    const int error = seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, call, static_cast<unsigned>(where.size()), where.begin());
    good = good && (error == 0 || error == -EDOM);  // -EDOM: a call that this processor's system does not have
  };
  for (const int call : free_calls) allow(call);
  constexpr scmp_datum_t changes = O_ACCMODE | O_CREAT | O_TRUNC | (O_TMPFILE & ~O_DIRECTORY);
  allow(SCMP_SYS(openat), {SCMP_A2(SCMP_CMP_MASKED_EQ, changes, O_RDONLY)});
  allow(SCMP_SYS(open), {SCMP_A1(SCMP_CMP_MASKED_EQ, changes, O_RDONLY)});
  allow(SCMP_SYS(write), {SCMP_A0(SCMP_CMP_LE, to_us)});
  allow(SCMP_SYS(mmap), {SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)});
  allow(SCMP_SYS(mprotect), {SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)});
  allow(SCMP_SYS(prlimit64), {SCMP_A2(SCMP_CMP_EQ, 0)});                                   // asked, not set
  allow(SCMP_SYS(tgkill), {SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid()))});  // abort()
  good = good && seccomp_load(filter) == 0;
  seccomp_release(filter);
  return good;
}

/// No file of ours but what it hands back; its words go nowhere.
void let_go_of_our_files(int file) {
  if (file != to_us) ::dup2(file, to_us);
  ::close_range(to_us + 1, ~0U, 0);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
}

void bound(rlim_t memory) {
  const rlimit no_core{0, 0}, space{memory, memory};
  ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer's shadow alone takes terabytes of address space
  ::setrlimit(RLIMIT_AS, &space);
#else
  static_cast<void>(space);
#endif
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
  constexpr std::size_t most_letters = 4096;
  const std::string file = place.file.substr(0, most_letters);
  return fmt::format("{} {} {}\n{}{}", place.line, place.column, file.size(), file, words.substr(0, most_letters));
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

[[noreturn, maybe_unused]] void be_the_copy(const std::function<std::string()>& read, const CopyBounds& bounds, int file) {
  let_go_of_our_files(file);
  bound(bounds.memory);
  if (!confine() && bounds.must_be_confined) ::_exit(cannot_confine);
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

/// All bytes of a file in memory that nobody writes any more.
std::string bytes_of(int file) {
  struct stat info {};
  if (::fstat(file, &info) != 0) throw std::system_error(errno, std::generic_category(), "what a copy handed back");
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t n = ::pread(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw std::system_error(n < 0 ? errno : EIO, std::generic_category(), "what a copy handed back");
    at += static_cast<std::size_t>(n);
  }
  return bytes;
}

/// What refusal_text() made; anything else, which a copy that somebody else steers could hand back, is words.
void take_refusal(CopyEnd& end) {
  end.how = CopyEnd::How::refused;
  const std::string bytes = end.bytes.substr(0, 10'000);
  std::size_t letters = 0;
  const auto start = bytes.find('\n') + 1;  // 0 where there is none
  if (std::sscanf(bytes.c_str(), "%d %d %zu", &end.place.line, &end.place.column, &letters) == 3 && start > 0 &&
      letters <= bytes.size() - start) {
    end.place.file = bytes.substr(start, letters);
    end.bytes = bytes.substr(start + letters);
  }
}

CopyEnd end_of(const ChildEnd& child, int file) {
  using How = CopyEnd::How;
  CopyEnd end;
  if (!child.in_time) {
    end.how = How::late;
  } else if (!WIFEXITED(child.status)) {
    end.how = How::killed;
    end.code = WTERMSIG(child.status);
  } else if (WEXITSTATUS(child.status) == cannot_confine) {
    end.how = How::not_confined;
  } else if (WEXITSTATUS(child.status) == memory_is_short) {
    end.how = How::no_memory;
  } else {
    end.bytes = bytes_of(file);
    if (WEXITSTATUS(child.status) != done) take_refusal(end);
  }
  return end;
}

}  // namespace

rlim_t CopyBounds::machine_memory() {
  return static_cast<rlim_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

CopyEnd read_in_confined_copy(const std::function<std::string()>& read, const CopyBounds& bounds) {
#if defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  return read_here(read);  // a process for each input would leave a fuzzer no inputs
#else
  const Descriptor handed(::memfd_create("tripoint-read", MFD_CLOEXEC));
  if (handed.get() < 0)
    throw std::system_error(errno, std::generic_category(),
                            bounds.what + " was not read: no file is to spare for what a copy of us reads");
  keep_ends_of_children();
  const pid_t child = ::fork();
  const int error = errno;
  if (child < 0)
    throw std::system_error(error, std::generic_category(),
                            bounds.what + " was not read: there is no process to spare to read it in");
  if (child == 0) be_the_copy(read, bounds, handed.get());
  return end_of(end_of_child(child, bounds.wall_limit), handed.get());
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
      return fmt::format("{} kills the library that reads it (signal {}, {})", what, end.code, ::strsignal(end.code));
    case How::late:
      return fmt::format("{} could not be read within {:g} s", what, bounds.wall_limit);
    case How::no_memory:
      return what + " takes more memory than this machine has";
    case How::not_confined:
      return what + " was not read: this system has no seccomp, by which the reader of a stranger's file is confined";
  }
  return {};
}

}  // namespace tripoint
