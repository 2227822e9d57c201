// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/sandbox_sums.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "validation/run/folder_sums.hpp"
#include "validation/run/strays.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
constexpr double mega = 1e6;
constexpr auto without_bound = std::numeric_limits<std::size_t>::max();
constexpr auto longest_stop = 10s;
constexpr std::size_t of_bubblewrap = 2;  // bubblewrap, and its first process inside
constexpr double low = 1.0 / 16.0;        // part of what was free at the start: then whoever takes much ends
constexpr double much = 0.25;             // part of its own limit

/// A process and all below it; no more than are needed to see that there are too many.
std::vector<pid_t> processes_from(pid_t outermost, std::size_t enough) {
  std::vector<pid_t> all{outermost};
  for (std::size_t n = 0; n < all.size() && all.size() <= enough; ++n)
    for (const pid_t child : children_of(all[n])) all.push_back(child);
  return all;
}

/// R, S, D, T (stopped), ...; 0 where it has ended.
char state_of(pid_t pid) {
  constexpr std::string_view key = "State:\t";
  std::ifstream status(fmt::format("/proc/{}/status", pid));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key) && line.size() > key.size()) return line[key.size()];
  return 0;
}

/// Memory of its own, with each page that several share counted once. That takes long to add up, so it is
/// done only where a quick sum, which counts such pages more than once, is too great.
double memory_of(const std::vector<pid_t>& all, double most) {
  double quick = 0.0, shared_out = 0.0;
  for (const pid_t pid : all)
    quick += kilobytes(fmt::format("/proc/{}/status", pid), {"RssAnon:", "RssShmem:"});
  if (quick <= most) return quick;
  for (const pid_t pid : all)
    shared_out += kilobytes(fmt::format("/proc/{}/smaps_rollup", pid), {"Pss_Anon:", "Pss_Shmem:"});
  return shared_out;
}

/// Files that have lost their names, and whose space is taken while a process has them open.
double nameless_bytes(const std::vector<pid_t>& all) {
  double sum = 0.0;
  for (const pid_t pid : all) {
    std::error_code none;
    for (fs::directory_iterator at(fmt::format("/proc/{}/fd", pid), none), end; !none && at != end;
         at.increment(none)) {
      struct stat status {};
      if (::stat(at->path().c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 0)
        sum += 512.0 * static_cast<double>(status.st_blocks);
    }
  }
  return sum;
}

/// Whether no process runs or waits for anything but a stopped one.
bool all_stand_still(const std::vector<pid_t>& all) {
  bool stopped = false;
  for (const pid_t pid : all) {
    const char state = state_of(pid);
    stopped = stopped || state == 'T';
    if (state != 'T' && (state != 'S' || children_of(pid).empty())) return false;
  }
  return stopped;
}

/// Files in the folders of a process that live in memory.
std::size_t files_in_memory(pid_t inside) {
  std::size_t files = 0;
  for (const char* folder : {"tmp", "dev/shm"}) {
    struct statvfs disk {};
    if (::statvfs(fmt::format("/proc/{}/root/{}", inside, folder).c_str(), &disk) == 0)
      files += disk.f_files - disk.f_ffree;
  }
  return files;
}

double free_space(const std::string& folder) {
  struct statvfs disk {};
  return ::statvfs(folder.c_str(), &disk) == 0
             ? static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize)
             : 0.0;
}

void give(const fs::path& path, unsigned owner) {
  struct stat status {};
  const bool has_other_names =
      ::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink > 1;
  if (!has_other_names) static_cast<void>(::lchown(path.c_str(), owner, owner) == 0);
}

void give_all(const std::string& folder, unsigned owner) {
  give(folder, owner);
  std::error_code none;
  for (fs::recursive_directory_iterator at(folder, none), end; !none && at != end; at.increment(none))
    give(at->path(), owner);
}

}  // namespace

double kilobytes(const std::string& file, const std::vector<std::string>& keys) {
  double sum = 0.0;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    for (const std::string& key : keys)
      if (line.starts_with(key)) sum += 1024.0 * std::atof(line.c_str() + key.size());
  return sum;
}

SandboxWatch::SandboxWatch(const SandboxSums& most, std::string folder)
    : most_(most), is_sandbox_(most.memory > 0.0 || most.processes > 0 || most.bytes > 0.0) {
  constexpr double share = 0.75;
  if (most_.memory > 0.0) free_memory_at_start_ = free_memory();
  if (folder.empty() || !(most_.bytes > 0.0 || most_.files > 0)) return;
  folder_ = std::move(folder);
  std::error_code none;
  for (fs::directory_iterator at(folder_, none), end; !none && at != end; at.increment(none))
    at_start_.insert(at->path().filename().string());
  if (most_.files > 0) most_.files += sums_of_folder(folder_, without_bound).entries;
  free_space_at_start_ = free_space(folder_);
  if (most_.bytes > 0.0 && free_space_at_start_ > 0.0)
    most_.bytes = std::min(most_.bytes, share * free_space_at_start_ / most_.at_once);
}

std::string SandboxWatch::passed(pid_t outermost) {
  const auto now = Clock::now();
  if (now < next_) return {};
  std::string words = look(outermost, now);
  next_ = Clock::now() + std::clamp<Clock::duration>(10 * (Clock::now() - now), 100ms, 2s);
  return words;
}

std::string SandboxWatch::passed_at_end() const {
  std::string words = of_files({});
  if (words.empty()) return words;
  remove_flat(folder_, at_start_);
  return whose() + words;
}

std::string SandboxWatch::whose() const { return is_sandbox_ ? "the sandbox has " : "its folder has "; }

std::string SandboxWatch::of_files(const std::vector<pid_t>& all) const {
  if (folder_.empty()) return {};
  const FolderSums taken = sums_of_folder(folder_, most_.files > 0 ? most_.files : without_bound);
  if (most_.files > 0 && !taken.unseen.empty()) return taken.unseen;
  if (most_.files > 0 && taken.entries > most_.files) return fmt::format("more than {} files", most_.files);
  if (!(most_.bytes > 0.0)) return {};
  const double sum = taken.bytes + nameless_bytes(all);
  if (sum > most_.bytes)
    return fmt::format("{:.0f} MB of files, and {:.0f} MB are allowed", sum / mega, most_.bytes / mega);
  if (const double left = free_space(folder_); left < low * free_space_at_start_ && sum > much * most_.bytes)
    return fmt::format("{:.0f} MB of files, and the disk has {:.0f} MB left", sum / mega, left / mega);
  return {};
}

std::string SandboxWatch::of_memory(const std::vector<pid_t>& all) const {
  if (!(most_.memory > 0.0)) return {};
  const double sum = memory_of(all, most_.memory);
  if (sum > most_.memory)
    return fmt::format("{:.0f} MB of memory, and {:.0f} MB are allowed", sum / mega, most_.memory / mega);
  if (sum <= much * most_.memory) return {};
  if (const double left = free_memory(); left < low * free_memory_at_start_)
    return fmt::format("{:.0f} MB of memory, and the machine has {:.0f} MB left", sum / mega, left / mega);
  return {};
}

bool SandboxWatch::stands_still(const std::vector<pid_t>& all, Clock::time_point now) {
  // Time in which we were stopped too, as by a queue that pauses a whole job, counts as one look
  const auto since = std::min<Clock::duration>(now - last_look_, 2s);
  last_look_ = now;
  still_for_ = all_stand_still(all) ? still_for_ + since : 0s;
  return still_for_ > longest_stop;
}

std::string SandboxWatch::look(pid_t outermost, Clock::time_point now) {
  const auto enough = static_cast<std::size_t>(most_.processes) + of_bubblewrap;
  const auto all = processes_from(outermost, most_.processes > 0 ? enough : std::size_t{4096});
  if (most_.processes > 0 && all.size() > enough)
    return fmt::format("{}more than {} processes", whose(), most_.processes);
  if (stands_still(all, now))
    return fmt::format("it was stopped (SIGSTOP) and not let go on for {} s", longest_stop / 1s);
  std::string words = of_memory(all);
  if (words.empty() && is_sandbox_ && most_.files > 0 && all.size() > of_bubblewrap &&
      files_in_memory(all.back()) > most_files)
    words = fmt::format("more than {} files in memory", most_files);
  if (words.empty()) words = of_files(all);
  return words.empty() ? words : whose() + words;
}

LentFolder::LentFolder(std::string folder) : folder_(std::move(folder)) {
  if (!folder_.empty()) give_all(folder_, sandbox_user);
}

LentFolder::~LentFolder() {
  if (!folder_.empty()) give_all(folder_, ::geteuid());
}

}  // namespace tripoint
