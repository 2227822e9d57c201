// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/supervise.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/children.hpp"
#include "files/job.hpp"
#include "files/result.hpp"

namespace tripoint::lammps {
namespace {

/// Output folder of the job, "" where the job cannot be read: the child then says why.
std::string output_of(const std::string& job_path) {
  try {
    return read_job(job_path).output;
  } catch (const std::exception&) {
    return {};
  }
}

/// LAMMPS's error and its last command, from the log.
std::string last_error(const std::string& log) {
  std::ifstream in(log);
  std::string text, line;
  while (std::getline(in, line))
    if (line.rfind("ERROR", 0) == 0)
      text = line;
    else if (!text.empty() && line.rfind("Last ", 0) == 0)
      text += "; " + line;
  return text;
}

int pass_on_signal(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return 128 + signal;
}

}  // namespace

int supervise(const std::string& job_path, int (*child)(int, char**), int argc, char** argv) {
  const std::string output = output_of(job_path), log = output + "/log.lammps",
                    result = output + "/result.json";
  std::error_code ignored;
  if (!output.empty()) {
    std::filesystem::remove(log, ignored);
    std::filesystem::remove(result, ignored);
  }
  keep_ends_of_children();
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid < 0) return 1;
  if (pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);  // the parent died before the line above
    ::dup2(STDERR_FILENO, STDOUT_FILENO);   // some styles of LAMMPS print where only results belong
    std::exit(child(argc, argv));
  }
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) return pass_on_signal(WTERMSIG(status));
  const std::string words = output.empty() || std::filesystem::exists(result, ignored) ? "" : last_error(log);
  if (words.empty()) return WEXITSTATUS(status);
  Result failed;
  failed.status = Status::error;
  failed.message = words;
  fmt::print(stderr, "error: {}\n", words);
  write_result(result, failed);
  return 1;
}

}  // namespace tripoint::lammps
