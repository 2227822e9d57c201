// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "adapters/tripoint/tripoint_engine.hpp"

namespace {

/// Threads that wait for each other spin for some tens of microseconds and then sleep. This is as fast as
/// spinning where the machine is quiet, and no waste where it is full. The library of threads reads its
/// settings before main, so the program begins once more with them.
void begin_with_short_waits(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  // Without memory for it the program would begin again for ever
  if (setenv("GOMP_SPINCOUNT", "1000", 1) != 0) return;
  std::error_code none;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", none);
  execv(program.c_str(), argv);  // where this fails, threads wait as they do by default
}

}  // namespace

int main(int argc, char** argv) {
  begin_with_short_waits(argv);
  return tripoint::serve(argc, argv,
                         [] { return std::unique_ptr<tripoint::Engine>(new tripoint::TripointEngine); });
}
