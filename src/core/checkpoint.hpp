// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tripoint {

/// The whole state of a run between two steps, as named arrays: whoever owns a part adds it under a name of its own, the solver
/// "particles/...", the engine "run/...", and takes it back when the run is continued. src/io writes and reads it as a file.
struct Checkpoint {
  std::map<std::string, std::vector<double>> real;
  std::map<std::string, std::vector<std::int64_t>> whole;
  std::map<std::string, std::vector<std::string>> text;
};

}  // namespace tripoint
