// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/strays.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace tripoint {
namespace {

namespace fs = std::filesystem;

/// Processes whose environment holds this entry. Those of other users cannot be read, and are none of ours.
std::vector<pid_t> marked(const std::string& entry) {
  std::vector<pid_t> found;
  std::error_code none;
  for (fs::directory_iterator at("/proc", none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    pid_t pid = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error != std::errc() || stop != name.data() + name.size() || pid == ::getpid()) continue;
    std::ifstream in(at->path() / "environ", std::ios::binary);
    const std::string environment{std::istreambuf_iterator<char>(in), {}};
    if (environment.find(entry) != std::string::npos) found.push_back(pid);
  }
  return found;
}

}  // namespace

std::string new_stray_mark() {
  static std::atomic<unsigned> next{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return fmt::format("{}.{}.{}", ::getpid(), now, next++);
}

void end_strays(const std::string& mark) {
  constexpr int rounds = 50;  // what forks faster than it is killed is slower after each round
  const std::string entry = fmt::format("{}={}", stray_mark, mark);
  for (int n = 0; n < rounds; ++n) {
    const auto strays = marked(entry);
    if (strays.empty()) return;
    for (const pid_t pid : strays) ::kill(pid, SIGKILL);
    for (const pid_t pid : strays) ::waitpid(pid, nullptr, WNOHANG);  // orphans come to us; one that stays dead has no environment
  }
}

}  // namespace tripoint
