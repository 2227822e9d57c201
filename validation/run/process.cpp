// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/process.hpp"
#include "validation/results/interrupt.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include "core/children.hpp"
#include "validation/run/instructions.hpp"
#include "validation/run/strays.hpp"
#include "validation/run/watch.hpp"

extern char** environ;

namespace tripoint {
namespace {

using Clock = std::chrono::steady_clock;
// [s] from SIGTERM to SIGKILL, for an engine that writes a checkpoint before it ends
constexpr double grace = 10.0;
constexpr std::size_t kept_output = 4u << 20, kept_log = 1u << 20, kept_tail = 4096;
constexpr std::size_t most_told = 1u << 30;  ///< [bytes]: who tells more tells without end

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void reset(int fd = -1) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = fd;
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

/// Keeps the beginning of a stream in a file, its end in memory, and counts what lies between: a flood costs
/// time, not disk.
class BoundedLog {
 public:
  explicit BoundedLog(const std::string& path) {
    if (path.empty()) return;
    // An earlier call of the engine may have left a link there, to a file of somebody else
    ::unlink(path.c_str());
    file_.reset(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644));
  }
  void add(const char* data, std::size_t size) {
    const std::size_t fits = std::min(size, kept_log - std::min(kept_log, written_));
    put(data, fits);
    written_ += fits;
    left_out_ += size - fits;
    tail_.append(data, size);
    if (tail_.size() > 2 * kept_tail) tail_.erase(0, tail_.size() - kept_tail);
  }
  std::string close() {
    if (left_out_ > 0) {
      const std::string end =
          fmt::format("\n[{} bytes are left out here; the end of the log was:]\n{}", left_out_, tail_);
      put(end.data(), end.size());
    }
    file_.reset();
    return tail_.size() > kept_tail ? tail_.substr(tail_.size() - kept_tail) : tail_;
  }

 private:
  void put(const char* data, std::size_t size) {
    while (file_.get() >= 0 && size > 0) {
      const ssize_t n = ::write(file_.get(), data, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return file_.reset();  // a full disk must not stop the run: the tail is still in memory
      data += n;
      size -= static_cast<std::size_t>(n);
    }
  }
  Descriptor file_;
  std::size_t written_ = 0, left_out_ = 0;
  std::string tail_;
};

/// Finds the lines `progress X` and `status REST` in a stream that arrives in pieces.
class ProgressLines {
 public:
  ProgressLines(const std::function<void(double)>& report,
                const std::function<void(const std::string&)>& status)
      : report_(report), status_(status) {}
  void add(const char* data, std::size_t size) {
    if (!report_ && !status_) return;
    for (std::size_t i = 0; i < size; ++i) {
      if (data[i] == '\n')
        end_line();
      else if (line_.size() < longest)
        line_ += data[i];
    }
  }

 private:
  void end_line() {
    if (status_ && line_.rfind("status ", 0) == 0) status_(line_.substr(7));
    if (report_ && line_.rfind("progress ", 0) == 0) {
      const double done = std::strtod(line_.c_str() + 9, nullptr);
      if (std::isfinite(done)) report_(std::clamp(done, 0.0, 1.0));
    }
    line_.clear();
  }
  static constexpr std::size_t longest = 407;
  const std::function<void(double)>& report_;
  const std::function<void(const std::string&)>& status_;
  std::string line_;
};

/// Bubblewrap is given none of our variables: whoever it starts can read its environment, as that of
/// process 1.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& added, bool in_sandbox) {
  std::vector<std::string> all;
  for (char** e = environ; *e && !in_sandbox; ++e) {
    const std::string entry = *e;
    if (!added.count(entry.substr(0, entry.find('=')))) all.push_back(entry);
  }
  for (const auto& [name, value] : added) all.push_back(name + "=" + value);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> p;
  for (auto& s : strings) p.push_back(s.data());
  p.push_back(nullptr);
  return p;
}

/// Starts the program in a process group of its own, with this mark in its environment. @return 0 or the
/// error number
int spawn(const ProcessSpec& spec, std::vector<std::string> argv, const std::string& mark, int out, int err,
          pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, 1);
  posix_spawn_file_actions_adddup2(&actions, err, 2);
  posix_spawn_file_actions_addclosefrom_np(&actions, 3);  // HDF5's files are not close-on-exec
  if (!spec.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, spec.folder.c_str());
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  auto added = spec.in_sandbox ? std::map<std::string, std::string>{} : spec.environment;
  added[stray_mark] = mark;
  auto environment = environment_with(added, spec.in_sandbox);
  const std::lock_guard lock(no_spawn_mutex());
  const int error = posix_spawn(&pid, argv.front().c_str(), &actions, &attributes, pointers(argv).data(),
                                pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

/// Allows no core files and no file above 16 GiB; the address space may not pass four times the machine's
/// memory.
void bound_resources(pid_t pid) {
  const rlimit no_core{0, 0}, file{16ull << 30, 16ull << 30};
  const auto memory =
      static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  const rlimit space{4 * memory, 4 * memory};
  prlimit(pid, RLIMIT_CORE, &no_core, nullptr);
  prlimit(pid, RLIMIT_FSIZE, &file, nullptr);
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer's shadow alone takes terabytes of address space
  prlimit(pid, RLIMIT_AS, &space, nullptr);
#endif
}

/// Greatest memory of a process so far [bytes], as it says itself while it lives; 0 when it has ended.
double peak_of(pid_t pid) {
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  constexpr std::string_view key = "VmHWM:";
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return 1024.0 * std::atof(line.c_str() + key.size());
  return 0.0;
}

/// The system's count of a child's memory begins with the peak of our process, which started it. It is the
/// child's own only where it is more.
void add_cost(ProcessEnd& end, const rusage& use) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  end.cpu_s += seconds(use.ru_utime) + seconds(use.ru_stime);
  rusage ours{};
  getrusage(RUSAGE_SELF, &ours);
  if (use.ru_maxrss > ours.ru_maxrss)
    end.peak_bytes = std::max(end.peak_bytes, 1024.0 * static_cast<double>(use.ru_maxrss));
}

/// Time until we look at a child again [ms]. It is a fifth of its run time so far, so that its memory is seen
/// in a short run too.
double until_next_look(double ran, double left) {
  return std::min({100.0, std::max(2.0, 200.0 * ran), 1e3 * left + 1.0});
}

/// Reads the bytes that are there, without waiting. @return false at the end of the stream
template <class Take>
bool drain(int fd, Take take) {
  char buffer[65536];
  for (int rounds = 0; rounds < 64; ++rounds) {  // a flood must not starve the clock
    const ssize_t n = ::read(fd, buffer, sizeof buffer);
    if (n > 0)
      take(buffer, static_cast<std::size_t>(n));
    else if (n == 0)
      return false;
    else if (errno != EINTR)
      return errno == EAGAIN;
  }
  return true;
}

/// Waits as wait4 does; a signal of ours that comes meanwhile does not end it.
pid_t wait_for(pid_t which, int options, int& status, rusage& use) {
  pid_t ended = -1;
  do {
    ended = ::wait4(which, &status, options, &use);
  } while (ended < 0 && errno == EINTR);
  return ended;
}

/// Waits until one of them has something to say. Where that cannot be waited for, all are asked after a
/// moment.
void wait_for_words(std::array<pollfd, 3>& wait, double most_ms) {
  if (::poll(wait.data(), wait.size(), static_cast<int>(most_ms)) >= 0) return;
  if (errno != EINTR) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  for (pollfd& one : wait) one.revents = POLLIN;
}

/// The leader has ended or must end: nothing of its group stays, and every member that is ours to reap is
/// paid for.
void end_group(pid_t leader, ProcessEnd& end, bool leader_reaped) {
  ::kill(-leader, SIGKILL);
  if (!leader_reaped) ::kill(leader, SIGKILL);  // it may have left its group, and we wait for it
  int status = 0;
  rusage use{};
  if (!leader_reaped && wait_for(leader, 0, status, use) == leader) add_cost(end, use);
  while (wait_for(-leader, 0, status, use) > 0) add_cost(end, use);
}

/// Adds the use of the first process inside a sandbox, and of all that it waited for. Bubblewrap ends without
/// waiting for it, and it comes to us. @param inside 0 where it was never seen
void add_cost_inside(pid_t inside, ProcessEnd& end) {
  if (inside == 0) return;
  const auto begun = Clock::now();
  std::optional<rusage> use;
  while (!(use = use_of_orphan(inside)) && seconds_since(begun) < 2.0) ::poll(nullptr, 0, 1);
  if (!use) return;
  add_cost(end, *use);
  // It began small, not as we
  end.peak_bytes = std::max(end.peak_bytes, 1024.0 * static_cast<double>(use->ru_maxrss));
}

void adopt_orphans() {
  static std::once_flag once;
  // Daemons that an engine leaves come to us, not to init
  std::call_once(once, [] { prctl(PR_SET_CHILD_SUBREAPER, 1); });
}

void kill_for(std::string why, ProcessEnd& end) {
  if (why.empty()) return;
  end.passed = std::move(why);
  end.how = ProcessEnd::How::signalled;
  end.code = SIGKILL;
}

/// Follows the child's streams until it ends, is out of time, or we are stopped.
void follow(const ProcessSpec& spec, pid_t pid, int out, int err, BoundedLog& log, SandboxWatch& watch,
            ProcessEnd& end) {
  const auto start = Clock::now();
  ProgressLines progress(spec.progress, spec.status);
  std::size_t told = 0;
  const auto take_output = [&](const char* p, std::size_t n) {
    told += n;
    end.output.append(p, std::min(n, kept_output - std::min(kept_output, end.output.size())));
  };
  const auto take_log = [&](const char* p, std::size_t n) {
    told += n;
    log.add(p, n);
    progress.add(p, n);
  };
  const Descriptor child(static_cast<int>(syscall(SYS_pidfd_open, pid, 0)));
  std::array<pollfd, 3> wait{pollfd{out, POLLIN, 0}, pollfd{err, POLLIN, 0}, pollfd{child.get(), POLLIN, 0}};
  bool reaped = false;
  pid_t inside = 0;
  std::optional<Clock::time_point> asked;
  while (!reaped) {
    const double left = spec.wall_limit - seconds_since(start);
    if (interrupted() && !spec.outlives_interrupt && !asked) {
      asked = Clock::now();
      ::kill(-pid, SIGTERM);
    }
    if (left <= 0.0 || (asked && seconds_since(*asked) > grace)) {
      end.how = ProcessEnd::How::timed_out;
      break;
    }
    kill_for(told > most_told ? fmt::format("it wrote more than {} MiB to stdout and stderr", most_told >> 20)
                              : watch.passed(pid),
             end);
    if (!end.passed.empty()) break;
    end.peak_bytes = std::max(end.peak_bytes, peak_of(pid));
    if (spec.in_sandbox && inside == 0)
      for (const pid_t first : children_of(pid)) inside = first;
    wait_for_words(wait, until_next_look(seconds_since(start), left));
    if (wait[0].revents && !drain(out, take_output)) wait[0].fd = -1;
    if (wait[1].revents && !drain(err, take_log)) wait[1].fd = -1;
    int status = 0;
    rusage use{};
    const pid_t ended = wait_for(pid, WNOHANG, status, use);
    if (ended < 0) {  // an end that nobody tells counts as a death, never as a good one
      reaped = true;
      end.how = ProcessEnd::How::signalled;
      end.code = SIGKILL;
    } else if (ended == pid) {
      reaped = true;
      add_cost(end, use);
      end.how = WIFEXITED(status) ? ProcessEnd::How::exited : ProcessEnd::How::signalled;
      end.code = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
    }
  }
  if (asked) {
    end.how = ProcessEnd::How::interrupted;
    end.code = stopped_by();
  }
  end_group(pid, end, reaped);
  add_cost_inside(inside, end);
  drain(out, take_output);
  drain(err, take_log);
  end.wall_s = seconds_since(start);
}

}  // namespace

std::mutex& no_spawn_mutex() {
  static std::mutex mutex;
  return mutex;
}

ProcessEnd run_process(const ProcessSpec& spec) {
  adopt_orphans();
  keep_ends_of_children();
  watch_for_our_end(our_stray_mark());
  const LentFolder lent(spec.lent);
  const ControlGroup group(spec.most);
  ProcessEnd end;
  int out[2], err[2];
  if (::pipe2(out, O_CLOEXEC | O_NONBLOCK) != 0) {
    end.log_tail = std::strerror(errno);
    return end;
  }
  const Descriptor out_read(out[0]);
  Descriptor out_write(out[1]);
  if (::pipe2(err, O_CLOEXEC | O_NONBLOCK) != 0) {
    end.log_tail = std::strerror(errno);
    return end;
  }
  const Descriptor err_read(err[0]);
  Descriptor err_write(err[1]);
  // The child writes blocking
  for (const int end_of_child : {out[1], err[1]}) ::fcntl(end_of_child, F_SETFL, 0);
  pid_t pid = -1;
  BoundedLog log(spec.log);  // before anybody can put something in its place
  SandboxWatch watch(spec.most, spec.folder);
  const InstructionCounter counter;
  const std::string mark = new_stray_mark();
  if (const int error = spawn(spec, group.begun_inside(spec.argv), mark, out[1], err[1], pid); error != 0) {
    end.log_tail = std::strerror(error);
    return end;
  }
  bound_resources(pid);
  out_write.reset();
  err_write.reset();
  follow(spec, pid, out[0], err[0], log, watch, end);
  end_strays(mark);
  auto left_files = watch.passed_at_end();  // they may pass their sum in less than a look
  if (end.passed.empty()) kill_for(std::move(left_files), end);
  if (end.passed.empty() && !(end.how == ProcessEnd::How::exited && end.code == 0))
    kill_for(group.passed(), end);
  end.log_tail = log.close();
  end.instructions = counter.read();
  return end;
}

std::string last_words(const std::string& log) {
  std::istringstream lines(log);
  std::string last, line;
  while (std::getline(lines, line))
    if (!line.empty() && line.rfind("progress ", 0) != 0 && line.rfind("status ", 0) != 0) last = line;
  return last.empty() ? "" : "; its last words: " + last.substr(0, 300);
}

std::string describe(const ProcessEnd& end) {
  constexpr const char* file_limit = ": a file grew beyond the limit of its size (ulimit -f, and 16 GiB)";
  switch (end.how) {
    case ProcessEnd::How::exited:
      return fmt::format("exited with code {}{}", end.code, end.code == 128 + SIGXFSZ ? file_limit : "");
    case ProcessEnd::How::signalled:
      if (!end.passed.empty()) return "was killed because " + end.passed;
      if (end.code == SIGXFSZ) return fmt::format("was killed by signal {}{}", end.code, file_limit);
      return fmt::format("was killed by signal {} ({})", end.code, strsignal(end.code));
    case ProcessEnd::How::timed_out:
      return fmt::format("was stopped after {:.0f} s", end.wall_s);
    case ProcessEnd::How::interrupted:
      return "was stopped by " + name_of_stop(end.code);
    case ProcessEnd::How::not_started:
      break;
  }
  return "could not be started: " + end.log_tail;
}

}  // namespace tripoint
