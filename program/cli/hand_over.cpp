// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/hand_over.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/errors.hpp"
#include "tables/library.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace fs = std::filesystem;

void hand_over(const std::string& program, const std::vector<std::string>& options,
               const std::vector<std::string>& operands) {
  const fs::path file = fs::path(share_folder()) / "reports" / program;
  if (!fs::exists(file)) throw EngineError("the program " + file.string() + " is missing");
  std::vector<std::string> words{python_program(), "-B", file.string()};
  words.insert(words.end(), options.begin(), options.end());
  words.emplace_back("--");
  words.insert(words.end(), operands.begin(), operands.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(words.front().c_str(), pointers.data());
  throw EngineError(fmt::format("{} cannot be started: {}", words.front(), std::strerror(errno)));
}

}  // namespace tripoint
