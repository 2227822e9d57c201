// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <utility>

/// Two calls that make runs in one folder would read and remove each other's files.
namespace tripoint {

/// Holds a folder of results against every other call while it lives. The system frees it where this process
/// is killed. Its file FOLDER/.lock stays, with the number of the process that held it last. A process holds
/// one folder at a time.
class FolderLock {
 public:
  /// @param folder is there
  /// @throws InputError naming the process that holds it, or what lies there in the place of the file
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int file_;
};

}  // namespace tripoint
