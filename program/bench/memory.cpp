// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/memory.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace tripoint::bench {
namespace {

/// A line of /proc/self/status, "VmRSS:   1234 kB"; 0 where there is none.
double status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) return 1024.0 * std::stod(line.substr(key.size()));
  return 0.0;
}

}  // namespace

double resident_bytes() { return status_bytes("VmRSS:"); }
double peak_bytes() { return status_bytes("VmHWM:"); }

void restart_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5\n";  // proc(5): sets the peak back to the present
}

}  // namespace tripoint::bench
