// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/try_in_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <new>

#include "core/children.hpp"
#include "core/errors.hpp"

namespace tripoint {
namespace {

constexpr int no_memory = 3;

void bound_the_copy() {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer's shadow alone takes terabytes of address space
  const auto memory = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  const rlimit space{memory, memory};
  setrlimit(RLIMIT_AS, &space);
#endif
  const int nothing = ::open("/dev/null", O_WRONLY);
  ::dup2(nothing, 1);
  ::dup2(nothing, 2);
}

[[noreturn]] void be_the_copy(const std::function<void()>& deed) {
  bound_the_copy();
  int code = 0;
  try {
    deed();
  } catch (const std::bad_alloc&) {
    code = no_memory;
  } catch (...) {  // a refusal: it is worded where it counts
  }
  ::_exit(code);
}

}  // namespace

void try_in_child(const std::function<void()>& deed, const std::string& what, double limit) {
  keep_ends_of_children();
  const pid_t child = ::fork();
  if (child < 0) throw EngineError(what + " was not read: there is no process to spare to try it in");
  if (child == 0) be_the_copy(deed);
  const auto [in_time, status] = end_of_child(child, limit);
  if (!in_time) throw EngineError(fmt::format("{} could not be read within {:g} s", what, limit));
  if (WIFSIGNALED(status))
    throw EngineError(
        fmt::format("{} kills the library that reads it (signal {}, {})", what, WTERMSIG(status), strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) == no_memory) throw EngineError(what + " takes more memory than this machine has");
}

}  // namespace tripoint
