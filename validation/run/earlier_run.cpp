// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/earlier_run.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* frames_name = "trajectory.h5";

bool is_frames(const std::string& name) {
  constexpr std::array names{frames_name, "trajectory.csv", "gauges.csv"};
  return std::ranges::find(names, name) != names.end();
}

bool is_checkpoint(const std::string& name) {
  return name.starts_with("checkpoint-") && name.ends_with(".h5");
}

/// Whether a run makes a file of this name. Pictures and tables that somebody has made of the run are none.
bool is_of_a_run(const std::string& name) {
  constexpr std::array names{"job.json", "result.json", "particles.h5", "trajectory.xdmf", "log.txt"};
  return is_frames(name) || is_checkpoint(name) || std::ranges::find(names, name) != names.end() ||
         (name.starts_with("outcome-") && name.ends_with(".json"));
}

/// Files of a run that lie in a folder, by name.
std::vector<std::string> run_files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none))
    if (const std::string name = at->path().filename().string(); is_of_a_run(name)) names.push_back(name);
  return names;
}

/// Number of a file in its file system, 0 where there is none.
std::uintmax_t file_number(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// Number of the frames that stayed in place, 0 where they were set aside too.
std::uintmax_t number_of_kept(const fs::path& aside) {
  std::uintmax_t number = 0;
  std::ifstream(aside / "kept") >> number;
  return number;
}

/// Whether a file stays in place for a run that goes on from it.
bool is_kept(const std::string& name) { return name == frames_name || is_checkpoint(name); }

}  // namespace

EarlierRun::EarlierRun(const std::string& folder, bool keeps_frames)
    : folder_(folder), aside_(folder_ / earlier_run_folder) {
  if (fs::is_directory(fs::symlink_status(aside_)) && !is_replaced()) put_back();
  fs::remove_all(aside_);  // a link that somebody left there is removed, and not followed
  fs::create_directory(aside_);
  if (keeps_frames) std::ofstream(aside_ / "kept") << file_number(folder_ / frames_name);
  for (const std::string& name : run_files_in(folder_))
    if (!keeps_frames || !is_kept(name)) fs::rename(folder_ / name, aside_ / name);
}

EarlierRun::~EarlierRun() {
  if (!kept_) return;
  try {
    put_back();
  } catch (const fs::filesystem_error&) {  // the next run in this folder finds them
  }
}

bool EarlierRun::is_replaced() const {
  return std::ranges::any_of(run_files_in(folder_), [&](const std::string& name) {
    return is_frames(name) && (name != frames_name || file_number(folder_ / name) != number_of_kept(aside_));
  });
}

void EarlierRun::let_go() noexcept {
  std::error_code none;
  fs::remove_all(aside_, none);
  kept_ = false;
}

/// What the attempt left stays where there was no run before it, for its log and result tell what was wrong.
void EarlierRun::put_back() const {
  const auto names = run_files_in(aside_);
  if (!names.empty())
    for (const std::string& name : run_files_in(folder_))
      if (number_of_kept(aside_) == 0 || !is_kept(name)) fs::remove_all(folder_ / name);
  for (const std::string& name : names) fs::rename(aside_ / name, folder_ / name);
  fs::remove_all(aside_);
}

}  // namespace tripoint
