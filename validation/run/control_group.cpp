// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <thread>

#include "validation/run/sandbox_sums.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
const fs::path root = "/sys/fs/cgroup";
constexpr std::string_view prefix = "tripoint-";  ///< of a group's name; then our number

struct Bound {
  const char *controller, *file, *file_v1;
  double value;
};

bool wrote(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  return static_cast<bool>(out << text << std::flush);
}

std::string new_name() {
  static std::atomic<unsigned> next{0};
  return fmt::format("{}{}-{}", prefix, ::getpid(), next++);
}

/// Our group in the hierarchy of a controller, "" in version 2; empty where there is none.
fs::path own_group(std::string_view controller) {
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string number, name, path;
    if (std::getline(fields, number, ':') && std::getline(fields, name, ':') && std::getline(fields, path) &&
        name == controller)
      return root / name / fs::path(path).relative_path();
  }
  return {};
}

std::optional<double> number_in(const fs::path& file) {
  double value = 0.0;
  std::ifstream in(file);
  return in >> value ? std::optional(value) : std::nullopt;
}

/// Memory of a group without the files that the kernel would give up [bytes].
double taken_in_group(const fs::path& group, bool newer) {
  double files = 0.0;
  std::ifstream in(group / "memory.stat");
  for (std::string key, value; in >> key >> value;)
    if (key == (newer ? "inactive_file" : "total_inactive_file")) files = std::atof(value.c_str());
  return number_in(group / (newer ? "memory.current" : "memory.usage_in_bytes")).value_or(0.0) - files;
}

/// Removes groups of programs that were killed before they could.
void remove_stale_groups(const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(prefix) &&
        !fs::exists("/proc/" + std::to_string(std::atol(name.c_str() + prefix.size()))))
      fs::remove(at->path(), none);
  }
}

/// A group of this name as near below ours as may be, with each bound; empty where none can be made.
fs::path group_below(const fs::path& ours, const fs::path& top,
                     const std::vector<std::pair<std::string, double>>& bounds) {
  const std::string name = new_name();
  std::error_code none;
  for (fs::path at = ours; !at.empty(); at = at.parent_path()) {
    const fs::path made = at / name;
    if (fs::create_directory(made, none)) {
      remove_stale_groups(at);
      bool bounded = true;
      for (const auto& [file, value] : bounds)
        bounded = bounded && wrote(made / file, fmt::format("{:.0f}", value));
      if (bounded && ::access((made / "cgroup.procs").c_str(), W_OK) == 0) return made;
      fs::remove(made, none);
    }
    if (at == top || at == at.root_path()) break;
  }
  return {};
}

}  // namespace

double free_memory() {
  double least = kilobytes("/proc/meminfo", {"MemAvailable:"});
  const bool newer = fs::exists(root / "cgroup.controllers");
  const fs::path top = newer ? root : root / "memory";
  for (fs::path at = own_group(newer ? "" : "memory"); !at.empty(); at = at.parent_path()) {
    // Version 2 says "max" where there is no bound
    if (const auto most = number_in(at / (newer ? "memory.max" : "memory.limit_in_bytes")))
      least = std::min(least, *most - taken_in_group(at, newer));
    if (at == top || at == at.root_path()) break;
  }
  return std::max(least, 0.0);
}

ControlGroup::ControlGroup(const SandboxSums& most) : memory_(most.memory) {
  if (!(most.memory > 0.0) || most.processes <= 0) return;
  // Bubblewrap, and its first process inside; what the watch ends a run at
  constexpr double ours = 2.0, one_too_many = 1.0;
  const double processes = most.processes + ours + one_too_many;
  if (fs::exists(root / "cgroup.controllers")) {
    if (auto made = group_below(own_group(""), root, {{"memory.max", most.memory}, {"pids.max", processes}});
        !made.empty())
      folders_.push_back(std::move(made));
    return;
  }
  for (const auto& [controller, file, value] : {std::tuple("memory", "memory.limit_in_bytes", most.memory),
                                                std::tuple("pids", "pids.max", processes)})
    if (auto made = group_below(own_group(controller), root / controller, {{file, value}}); !made.empty())
      folders_.push_back(std::move(made));
}

ControlGroup::~ControlGroup() {
  using namespace std::chrono_literals;
  for (const fs::path& folder : folders_) {
    std::error_code failed;
    for (int n = 0; n < 1000 && !fs::remove(folder, failed) && failed; ++n) std::this_thread::sleep_for(2ms);
  }
}

std::string ControlGroup::passed() const {
  for (const fs::path& folder : folders_)
    for (const char* file : {"memory.events", "memory.oom_control"}) {
      std::ifstream in(folder / file);
      for (std::string key, value; in >> key >> value;)
        if (key == "oom_kill" && std::atof(value.c_str()) > 0.0)
          return fmt::format("the sandbox has more than {:.0f} MB of memory", memory_ / 1e6);
    }
  return {};
}

std::vector<std::string> ControlGroup::begun_inside(const std::vector<std::string>& argv) const {
  if (folders_.empty()) return argv;
  std::vector<std::string> words{
      "/bin/sh", "-c",
      R"(n=$1; shift; while [ "$n" -gt 0 ]; do echo $$ >"$1"; shift; n=$((n - 1)); done; exec "$@")", "sh",
      std::to_string(folders_.size())};
  for (const fs::path& folder : folders_) words.push_back((folder / "cgroup.procs").string());
  words.insert(words.end(), argv.begin(), argv.end());
  return words;
}

}  // namespace tripoint
