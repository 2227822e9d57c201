// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/strays.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace tripoint {
namespace {

namespace fs = std::filesystem;

/// Result of a look over all processes.
struct Look {
  std::vector<pid_t> marked;
  // One of ours is just becoming another program: for that moment nobody can read its environment
  bool unsure = false;
};

/// The readable part of a file. Reading fails in the middle where the process ends just then, and a bare
/// iterator would throw at it.
std::string all_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Data of the system about a process: fields 3, 4, 6, 50, 51 of proc(5).
struct Standing {
  bool known = false;  ///< false: it is gone, to the last trace
  bool alive = false;
  bool was_given_none = false;  ///< no environment
  pid_t parent = 0, session = 0;
};

Standing standing_of(const fs::path& process) {
  const std::string line = all_of(process / "stat");
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  const std::vector<std::string> field{std::istream_iterator<std::string>(fields), {}};
  constexpr std::size_t state = 0, parent = 1, session = 3, environment_start = 47, environment_end = 48;
  if (field.size() <= environment_end) return {};
  Standing s;
  s.known = true;
  s.alive = field[state] != "Z" && field[state] != "X";
  s.was_given_none = field[environment_end] != "0" && field[environment_start] == field[environment_end];
  s.parent = static_cast<pid_t>(std::atol(field[parent].c_str()));
  s.session = static_cast<pid_t>(std::atol(field[session].c_str()));
  return s;
}

/// Whether a process whose environment we read as empty is a child of ours, alive, and not one that was given
/// none.
bool is_becoming_another(const fs::path& process) {
  const Standing s = standing_of(process);
  return s.alive && s.parent == ::getpid() && !s.was_given_none;
}

/// Whether this environment has the entry, as it is or with parts after it.
bool carries(const std::string& environment, const std::string& entry) {
  for (auto at = environment.find(entry); at != std::string::npos; at = environment.find(entry, at + 1)) {
    const std::size_t end = at + entry.size();
    if (end == environment.size() || environment[end] == '\0' || environment[end] == mark_end) return true;
  }
  return false;
}

/// Finds processes whose environment holds this entry. Processes of other users cannot be read, and are none
/// of ours.
Look look_for(const std::string& entry) {
  Look look;
  std::error_code none;
  for (fs::directory_iterator at("/proc", none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    pid_t pid = 0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error != std::errc() || stop != name.data() + name.size() || pid == ::getpid()) continue;
    const std::string environment = all_of(at->path() / "environ");
    if (carries(environment, entry))
      look.marked.push_back(pid);
    else if (environment.empty() && is_becoming_another(at->path()))
      look.unsure = true;
  }
  return look;
}

/// Resources that the buried orphans have used, by process.
std::mutex graves;
std::map<pid_t, rusage> buried;

/// Waits for a process that came to us, where it has ended. @return whether it had
bool bury(pid_t pid) {
  const std::lock_guard lock(graves);
  rusage use{};
  if (::wait4(pid, nullptr, WNOHANG, &use) != pid) return false;
  constexpr std::size_t most = 4096;  // a storm of processes: nobody asks for these
  if (buried.size() >= most) buried.clear();
  buried[pid] = use;
  return true;
}

/// Kills children of ours that have this entry. Buries children that came to us from sessions of their own
/// and have ended: nobody else waits for them. It takes a tenth of the time of a look over all processes. So
/// it catches a program that keeps moving to a new process. @return whether there was any of either
bool end_children(const std::string& entry) {
  bool found = false;
  for (const pid_t pid : children_of(::getpid())) {
    const fs::path process = fmt::format("/proc/{}", pid);
    if (carries(all_of(process / "environ"), entry)) {
      ::kill(pid, SIGKILL);
      found = true;
    } else if (const Standing s = standing_of(process); s.known && !s.alive && s.session != ::getsid(0)) {
      found |= bury(pid);
    }
  }
  return found;
}

}  // namespace

const std::string& our_stray_mark() {
  static const std::string mark = [] {
    const char* carried = std::getenv(stray_mark);
    const std::string before = carried ? std::string(carried) + mark_end : "";
    return fmt::format("{}{}.{}", before, ::getpid(),
                       std::chrono::steady_clock::now().time_since_epoch().count());
  }();
  return mark;
}

std::string new_stray_mark() {
  static std::atomic<unsigned> next{0};
  return fmt::format("{}{}{}", our_stray_mark(), mark_end, next++);
}

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  std::error_code none;
  for (fs::directory_iterator at(fmt::format("/proc/{}/task", parent), none), end; !none && at != end;
       at.increment(none)) {
    std::istringstream list(all_of(at->path() / "children"));
    for (pid_t pid = 0; list >> pid;) found.push_back(pid);
  }
  return {found.rbegin(), found.rend()};  // the newest first
}

std::optional<rusage> use_of_orphan(pid_t pid) {
  static_cast<void>(bury(pid));
  const std::lock_guard lock(graves);
  const auto at = buried.find(pid);
  if (at == buried.end()) return {};
  const rusage use = at->second;
  buried.erase(at);
  return use;
}

void end_strays(const std::string& mark) {
  using namespace std::chrono_literals;
  constexpr auto patience = 2s;  // to become another program takes milliseconds, on a busy machine too
  constexpr auto longest = 10s;  // for what starts others as fast as it is killed
  constexpr int looks = 5;       // the list of children may leave out one that comes while it is made
  const auto start = std::chrono::steady_clock::now();
  const std::string entry = fmt::format("{}={}", stray_mark, mark);
  for (;;) {
    const auto ran = std::chrono::steady_clock::now() - start;
    bool found = false;
    for (int look = 0; look < looks && !found; ++look) found = end_children(entry);
    if (found && ran < longest) continue;
    const auto [strays, unsure] = look_for(entry);
    if (strays.empty() && (!unsure || ran > patience)) return;
    if (ran > longest) return;
    for (const pid_t pid : strays) ::kill(pid, SIGKILL);
    for (const pid_t pid : strays) bury(pid);  // orphans come to us; one that stays dead has no environment
    if (strays.empty()) std::this_thread::sleep_for(1ms);
  }
}

}  // namespace tripoint
