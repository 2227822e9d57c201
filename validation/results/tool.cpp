// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <thread>

#include "commit.hpp"  // written by the build: TRIPOINT_COMMIT
#include "validation/results/results.hpp"

namespace tripoint {
namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

}  // namespace

Tool this_tool() {
#if defined(__clang__)
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "g++ " __VERSION__;
#endif
  return {TRIPOINT_VERSION, TRIPOINT_COMMIT, compiler,
          TRIPOINT_FLAGS,   cpu_name(),      static_cast<int>(std::thread::hardware_concurrency())};
}

}  // namespace tripoint
