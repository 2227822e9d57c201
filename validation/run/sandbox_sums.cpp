// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/sandbox_sums.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "validation/run/strays.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
constexpr std::size_t most_files = 100'000;

/// A process and all below it; no more than are needed to see that there are too many.
std::vector<pid_t> processes_from(pid_t outermost, std::size_t enough) {
  std::vector<pid_t> all{outermost};
  for (std::size_t n = 0; n < all.size() && all.size() <= enough; ++n)
    for (const pid_t child : children_of(all[n])) all.push_back(child);
  return all;
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

double room_of(const struct stat& status) { return 512.0 * static_cast<double>(status.st_blocks); }

/// Files that have lost their names, and whose room is taken while a process has them open.
double nameless_bytes(const std::vector<pid_t>& all) {
  double sum = 0.0;
  for (const pid_t pid : all) {
    std::error_code none;
    for (fs::directory_iterator at(fmt::format("/proc/{}/fd", pid), none), end; !none && at != end;
         at.increment(none)) {
      struct stat status {};
      if (::stat(at->path().c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 0)
        sum += room_of(status);
    }
  }
  return sum;
}

struct Taken {
  double bytes = 0.0;
  std::size_t files = 0;
};

Taken taken_in(const std::string& folder) {
  Taken taken;
  std::error_code none;
  for (fs::recursive_directory_iterator at(folder, none), end;
       !none && at != end && taken.files <= most_files; at.increment(none)) {
    struct stat status {};
    if (::lstat(at->path().c_str(), &status) != 0) continue;
    taken.bytes += room_of(status);
    ++taken.files;
  }
  return taken;
}

/// Files in the folders of a process that live in memory.
std::size_t files_in_memory(pid_t inside) {
  std::size_t files = 0;
  for (const char* folder : {"tmp", "dev/shm"}) {
    struct statvfs room {};
    if (::statvfs(fmt::format("/proc/{}/root/{}", inside, folder).c_str(), &room) == 0)
      files += room.f_files - room.f_ffree;
  }
  return files;
}

double free_room(const std::string& folder) {
  struct statvfs room {};
  return ::statvfs(folder.c_str(), &room) == 0
             ? static_cast<double>(room.f_bavail) * static_cast<double>(room.f_frsize)
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
    : most_(most), folder_(std::move(folder)) {
  constexpr double share = 0.75;
  if (folder_.empty()) return;
  if (const double room = free_room(folder_); room > 0.0) most_.bytes = std::min(most_.bytes, share * room);
  std::error_code none;
  for (fs::directory_iterator at(folder_, none), end; !none && at != end; at.increment(none))
    at_start_.insert(at->path());
}

std::string SandboxWatch::passed(pid_t outermost) {
  const auto now = Clock::now();
  if (now < next_) return {};
  std::string words = look(outermost);
  next_ = Clock::now() + std::clamp<Clock::duration>(10 * (Clock::now() - now), 100ms, 2s);
  return words;
}

std::string SandboxWatch::passed_at_end() {
  if (folder_.empty() || !(most_.bytes > 0.0)) return {};
  std::string words = of_files({});
  std::error_code none;
  if (!words.empty())
    for (fs::directory_iterator at(folder_, none), end; !none && at != end; at.increment(none))
      if (!at_start_.contains(at->path())) fs::remove_all(at->path(), none);
  return words;
}

std::string SandboxWatch::of_files(const std::vector<pid_t>& all) const {
  constexpr double mega = 1e6;
  const Taken taken = taken_in(folder_);
  if (taken.files > most_files) return fmt::format("more than {} files", most_files);
  if (const double sum = taken.bytes + nameless_bytes(all); sum > most_.bytes)
    return fmt::format("{:.0f} MB of files, and {:.0f} MB are allowed", sum / mega, most_.bytes / mega);
  return {};
}

std::string SandboxWatch::look(pid_t outermost) const {
  constexpr std::size_t ours = 2;  // bubblewrap, and its first process inside
  constexpr double mega = 1e6;
  const auto enough = static_cast<std::size_t>(most_.processes) + ours;
  const auto all = processes_from(outermost, most_.processes > 0 ? enough : std::size_t{4096});
  if (most_.processes > 0 && all.size() > enough)
    return fmt::format("more than {} processes", most_.processes);
  if (const double sum = most_.memory > 0.0 ? memory_of(all, most_.memory) : 0.0; sum > most_.memory)
    return fmt::format("{:.0f} MB of memory, and {:.0f} MB are allowed", sum / mega, most_.memory / mega);
  if (folder_.empty() || !(most_.bytes > 0.0)) return {};
  if (all.size() > ours && files_in_memory(all.back()) > most_files)
    return fmt::format("more than {} files in memory", most_files);
  return of_files(all);
}

LentFolder::LentFolder(std::string folder) : folder_(std::move(folder)) {
  if (!folder_.empty()) give_all(folder_, sandbox_user);
}

LentFolder::~LentFolder() {
  if (!folder_.empty()) give_all(folder_, ::geteuid());
}

}  // namespace tripoint
