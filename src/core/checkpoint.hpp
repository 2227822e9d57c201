// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tripoint {

/// The whole state of a run between two steps, as named arrays. Each owner of a part adds it under its own
/// name, the solver "particles/...", the engine "run/...". It takes the part back when the run is continued.
/// src/files writes and reads it as a file.
struct Checkpoint {
  std::map<std::string, std::vector<double>> real;
  std::map<std::string, std::vector<std::int64_t>> whole;
  std::map<std::string, std::vector<std::string>> text;
};

}  // namespace tripoint
