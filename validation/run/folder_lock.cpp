// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/errors.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

std::atomic<int> held{-1};

/// A copy of us that tries a file outlives us where we are killed: it must not hold what we held.
void let_go_in_a_copy() {
  if (const int file = held.exchange(-1); file >= 0) ::close(file);
}

/// "process 123", as the holder wrote it.
std::string holder(int file) {
  std::array<char, 32> text{};
  const ssize_t n = ::pread(file, text.data(), text.size() - 1, 0);
  const long pid = n > 0 ? std::strtol(text.data(), nullptr, 10) : 0;
  return pid > 0 ? fmt::format("process {}", pid) : "another process";
}

/// For the next process. A full disk takes no number; the folder is held all the same.
void sign(int file) {
  const std::string pid = fmt::format("{}\n", ::getpid());
  if (::ftruncate(file, 0) != 0) return;
  static_cast<void>(::pwrite(file, pid.data(), pid.size(), 0) == static_cast<ssize_t>(pid.size()));
}

/// A link or a second name would have us write into a file of somebody else.
bool is_own_file(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) {
  static const int registered = ::pthread_atfork(nullptr, nullptr, let_go_in_a_copy);
  static_cast<void>(registered);
  const std::string path = (std::filesystem::path(folder) / ".lock").string(), shown = printable(path, 200);
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  const int why = errno;
  if (file_ < 0 && why != ELOOP)
    throw InputError(
        fmt::format("{}: cannot be opened: {}. Name another folder with --out", shown, std::strerror(why)));
  if (file_ < 0 || !is_own_file(file_)) {
    ::close(file_);
    throw InputError(fmt::format(
        "{}: is no plain file, which keeps this folder for one call at a time. Remove it", shown));
  }
  // A file system without locks says so by another error: there a folder cannot be held.
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    const std::string who = holder(file_);
    ::close(file_);
    throw InputError(fmt::format(
        "{}: {} writes into this folder and holds {}. Wait until it has ended, or name another folder "
        "with --out",
        printable(folder, 200), who, shown));
  }
  sign(file_);
  held = file_;
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  int ours = file_;
  held.compare_exchange_strong(ours, -1);
  ::close(file_);
}

}  // namespace tripoint
