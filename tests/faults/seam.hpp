// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the parts of the seam share: the plan of what is to fail, and what becomes of a call. seam.cpp says
// how a plan is told.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fault_seam {

#define NEXT(name) static auto* const next = reinterpret_cast<decltype(&(name))>(dlsym(RTLD_NEXT, #name))

/// A call of the system that passes by what stands here.
template <class... Words>
long raw(long number, Words... words) {
  static long (*next)(long, ...);  // without a guard: the first call may come from within its own making
  if (!next) next = reinterpret_cast<long (*)(long, ...)>(dlsym(RTLD_NEXT, "syscall"));
  return next(number, words...);
}

[[nodiscard]] const char* said(const char* name);
/// Whether this is the process that is meant. No memory is asked for.
[[nodiscard]] bool is_meant();
[[noreturn]] void die();

/// What a loss of power would undo: a file or folder that came to be, bytes that were written or cut off,
/// another name, a file or folder that went.
struct Unsynced {
  enum class What { made, bytes, renamed, removed } what;
  std::string path, old_path;  ///< old_path: of a renamed file
  off_t at = 0, size = 0;      ///< where bytes were written; size of the file before
  std::string bytes;           ///< that were there
  /// What a renamed file replaced; of what was removed: a folder
  bool existed = false;
  long rename = 0;  ///< number of this change, where it is a rename
  /// Renames that moved the file since, each with the name that it had before
  std::vector<std::pair<long, std::string>> former;
};

constexpr const char* sticky_word = "+sticky";

/// Calls of one set are counted together.
enum class Set : size_t { files, name, read, stream, fork, spawn, pipe, poll, pidfd, wait, kill, limit };
constexpr std::array<std::string_view, 12> set_names{"files", "name", "read",  "stream", "fork", "spawn",
                                                     "pipe",  "poll", "pidfd", "wait",   "kill", "limit"};

/// One call that fails, or all from it on.
struct Fault {
  long at = 0;
  Set set = Set::files;
  std::string kind;
  bool sticky = false;
};

[[nodiscard]] std::vector<Fault> faults_asked();

using Counters = std::array<std::atomic<long>, set_names.size()>;

[[nodiscard]] Counters& shared_counters();
[[nodiscard]] bool is_about_memory();

[[nodiscard]] bool any_loses(const std::vector<Fault>&);

struct Plan {
  std::vector<Fault> faults = faults_asked();
  long seed = std::atol(said("FAULT_SEED"));
  std::string folder = said("FAULT_FOLDER"), log = said("FAULT_LOG");
  /// Where memory is meant, this file asks for none on the program's account
  bool meant = is_meant() && !is_about_memory();
  bool counts_only = faults.size() == 1 && faults[0].at == 0;
  bool loses = any_loses(faults);
  bool jumps = false;  ///< the date does
  Counters& calls = shared_counters();
  std::vector<Unsynced> unsynced;
  long renames = 0;
  std::recursive_mutex mutex;
};

[[nodiscard]] Plan*& made_plan();
[[nodiscard]] Plan& plan();

[[nodiscard]] std::string path_of(int fd);
[[nodiscard]] std::string absolute(const char* path);
[[nodiscard]] std::string bytes_at(const std::string& path, off_t at, size_t count);
[[nodiscard]] off_t size_of(const std::string& path);

/// What is kept of a change, so that a loss of power can undo it.
void remember_bytes(const std::string& path, off_t at, size_t count);
void remember_made(const std::string& path);
/// After an fsync of a file its bytes are durable, after that of a folder the names in it.
void made_durable(const std::string& path);

enum class Fate { passes, fails, half_and_on, half_and_dies, done_and_dies };

/// What becomes of a call. Where it fails, errno says why.
[[nodiscard]] Fate fate(Set set, const char* operation, const std::string& path);

/// A call that is done whole or not at all. @param call does it
template <class Call>
auto whole(Set set, const char* operation, const std::string& path, Call call) -> decltype(call()) {
  const std::lock_guard lock(plan().mutex);
  const Fate f = fate(set, operation, path);
  if (f == Fate::fails) return static_cast<decltype(call())>(-1);
  if (f == Fate::half_and_dies) die();
  const auto result = call();
  if (f == Fate::done_and_dies) die();
  return result;
}

/// A call about children. It may wait, so that nothing is held meanwhile.
template <class Call>
auto child_by(Set set, const char* operation, Call call) -> decltype(call()) {
  if (!plan().meant) return call();
  const Fate f = [&] {
    const std::lock_guard lock(plan().mutex);
    return fate(set, operation, "");
  }();
  if (f == Fate::fails) return static_cast<decltype(call())>(-1);
  if (f == Fate::half_and_dies) die();
  const auto result = call();
  if (f == Fate::done_and_dies && !(set == Set::fork && result == 0)) die();
  return result;
}

}  // namespace fault_seam
