// SPDX-License-Identifier: BSD-3-Clause
#include "cli/common.hpp"

#include <cstdio>
#include <filesystem>
#include <sstream>

#include "core/errors.hpp"
#include "validation/harness/verdict.hpp"

namespace tripoint {
namespace {
std::string& remembered() {
  static std::string line;
  return line;
}
}  // namespace

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& e) {
    say(std::string("tripoint: ") + e.what());
    return exit_bad_input;
  } catch (const Diverged& e) {
    say(std::string("tripoint: diverged: ") + e.what());
    return exit_diverged;
  } catch (const std::exception& e) {
    say(std::string("tripoint: ") + e.what());
    return exit_missing;
  }
}

void say(const std::string& line) {
  std::fwrite((line + "\n").data(), 1, line.size() + 1, stderr);
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

std::vector<std::string> split(const std::string& list, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

EngineWords sort_engine_words(const std::vector<std::string>& words) {
  EngineWords sorted;
  for (const auto& word : words)
    (word.find('/') != std::string::npos || std::filesystem::exists(word) ? sorted.paths : sorted.names).push_back(word);
  return sorted;
}

void remember_command_line(int argc, char** argv) {
  remembered() = "tripoint";
  for (int i = 1; i < argc; ++i) remembered() += std::string(" ") + argv[i];
}

const std::string& command_line() { return remembered(); }

Plan plan_of(const CaseReading& reading) {
  try {
    return plan(scene_for(reading.value, {}));
  } catch (const InputError& e) {
    if (!e.place().file.empty()) throw;
    throw InputError({reading.value.file, 0, 0}, e.what());
  }
}

}  // namespace tripoint
