// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/keeper.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "adapters/ranks/last_words.hpp"
#include "core/children.hpp"
#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

/// The number that the process manager gave to this process; -1 where none did.
int number_from_manager() {
  const char* number = std::getenv("PMI_RANK");
  return number && *number ? std::atoi(number) : -1;
}

void end_by(int signal) {
  const rlimit no_core{0, 0};  // the rank's own is enough
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(signal, SIG_DFL);
  sigset_t mask;
  sigemptyset(&mask);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  std::raise(signal);
}

}  // namespace

int keep_a_rank(const std::string& output, const std::function<int()>& be_a_rank) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  keep_ends_of_children();
  sigset_t all, before;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &before);  // signals to our group are for the rank alone
  const pid_t keeper = ::getpid(), rank = ::fork();
  if (rank < 0) throw EngineError(std::string("a rank could not be started: ") + std::strerror(errno));
  if (rank == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != keeper) ::_exit(1);  // the keeper died before the line above
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    std::exit(be_a_rank());
  }
  int status = SIGKILL;  // an end that nobody tells is no good one
  while (::waitpid(rank, &status, 0) < 0 && errno == EINTR) {
  }
  if (const int number = number_from_manager(); number >= 0) note_end(output, number, status);
  if (WIFSIGNALED(status)) end_by(WTERMSIG(status));
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace tripoint::ranks
