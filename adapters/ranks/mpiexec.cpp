// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/mpiexec.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "adapters/engine/stops.hpp"
#include "adapters/ranks/giving_way.hpp"
#include "adapters/ranks/last_words.hpp"
#include "adapters/ranks/ranks_engine.hpp"
#include "core/children.hpp"
#include "core/stop_signals.hpp"

namespace tripoint::ranks {
namespace {

namespace fs = std::filesystem;

/// File for the messages of mpiexec, where they do not get into the engine's answers.
std::string log_of(const std::string& output) { return output + "/mpiexec.log"; }

volatile sig_atomic_t mpiexec_pid = 0, stop_came = 0;

/// mpiexec hands SIGINT on to the ranks, which leave a checkpoint. It would answer SIGTERM, and a second
/// SIGINT, by killing them. A second SIGHUP does not ask for that.
extern "C" void on_stop_of_ranks(int signal) {
  if (signal == SIGHUP && stop_came) return;
  stop_came = 1;
  if (mpiexec_pid > 0) ::kill(static_cast<pid_t>(mpiexec_pid), SIGINT);
}

/// Until mpiexec is known no such signal is answered. @return the signals that this process blocked before
sigset_t hold_stops() {
  sigset_t stops, before;
  sigemptyset(&stops);
  for (const int signal : stop_signals) sigaddset(&stops, signal);
  ::sigprocmask(SIG_BLOCK, &stops, &before);
  return before;
}

/// From now on Ctrl-C, SIGTERM and SIGHUP are for the ranks; a second Ctrl-C or SIGTERM ends us at once, and
/// them with us.
void hand_stops_on(pid_t mpiexec, const sigset_t& before) {
  mpiexec_pid = mpiexec;
  on_stop_signals(on_stop_of_ranks);
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
}

/// mpiexec and its ranks as children; they end with this process. @return status as wait() gives it
int start_and_wait(const Wheel& wheel, int count, const std::string& job_path, const std::string& output) {
  std::error_code ignored;
  const std::string self = fs::read_symlink("/proc/self/exe", ignored).string(),
                    ranks = std::to_string(count), log = log_of(output);
  // hydra's: fork for this machine; slurm or ssh for several nodes, which nobody has tried
  const char* chosen = std::getenv("TRIPOINT_MPI_LAUNCHER");
  const std::string launcher = chosen && *chosen ? chosen : "fork";
  keep_ends_of_children();
  const sigset_t before = hold_stops();
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid < 0) throw EngineError(std::string("mpiexec could not be started: ") + std::strerror(errno));
  if (pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);  // the parent died before the line above
    ::setpgid(0, 0);                        // signals to our group are for the parent alone
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    const int nothing = ::open("/dev/null", O_RDONLY),
              words = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(words, STDOUT_FILENO);
    let_waits_give_way();
    ::execl(wheel.mpiexec.c_str(), wheel.mpiexec.c_str(), "-launcher", launcher.c_str(), "-n", ranks.c_str(),
            self.c_str(), "--rank", job_path.c_str(), nullptr);
    ::_exit(127);
  }
  hand_stops_on(pid, before);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  mpiexec_pid = 0;
  return status;
}

/// Result that a rank wrote as it failed; else the ranks that a signal ended, and their last words.
Result result_of_failure(const std::string& output, int count, int status) {
  std::error_code none;
  for (int rank = 0; rank < count; ++rank) {
    if (!fs::exists(failure_file(output, rank), none)) continue;
    Result failed = read_result(failure_file(output, rank));
    failed.message = fmt::format("rank {}: {}", rank, failed.message);
    return failed;
  }
  Result failed;
  failed.status = Status::error;
  for (int rank = 0; rank < count; ++rank) {
    const LastWords words = last_words(output, rank);
    if (words.end.empty()) continue;
    failed.message +=
        fmt::format("{}rank {} of {} {}; its last words: {}", failed.message.empty() ? "" : "; ", rank, count,
                    words.end, words.how_far.empty() ? "none, it had not begun to step" : words.how_far);
  }
  if (failed.message.empty())
    failed.message = fmt::format(
        "the ranks ended without a result, and none was seen to be ended by a signal; mpiexec {} {}, and its "
        "words "
        "are in {}",
        WIFSIGNALED(status) ? "was ended by signal" : "gave exit code",
        WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), log_of(output));
  return failed;
}

int exit_code_of(const Result& result) {
  return result.status == Status::ok         ? 0
         : result.status == Status::refused  ? 4
         : result.status == Status::diverged ? 7
                                             : 1;
}

}  // namespace

int run_ranks(const std::string& job_path) {
  const Job job = read_job(job_path);
  const int count = ranks_of(job);
  const std::string result = job.output + "/result.json";
  std::error_code ignored;
  fs::create_directories(job.output);
  fs::remove(result, ignored);
  for (int rank = 0; rank < count; ++rank) {
    fs::remove(failure_file(job.output, rank), ignored);
    fs::remove(words_file(job.output, rank), ignored);
  }
  const int status = start_and_wait(find_wheel(), count, job_path, job.output);
  const bool left_checkpoint = WIFEXITED(status) && WEXITSTATUS(status) == exit_interrupted;
  if (fs::exists(result, ignored))
    return left_checkpoint ? exit_interrupted : exit_code_of(read_result(result));
  Result failed = result_of_failure(job.output, count, status);
  if (stop_came) failed.message = "interrupted before the ranks could leave a checkpoint; " + failed.message;
  std::fputs(fmt::format("{}: {}\n", failed.status, failed.message).c_str(), stderr);
  write_result(result, failed);
  return stop_came ? exit_interrupted : exit_code_of(failed);
}

}  // namespace tripoint::ranks
