// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "core/errors.hpp"

/// Files that are written by calls of the system: a stream of the library would not say why it failed.
namespace tripoint {

/// Writes all of it in as many calls as that takes. @param write takes the remaining bytes and answers as
/// write(2) does
/// @return 0, or the errno of the call that failed
template <class Write>
[[nodiscard]] int write_whole(std::string_view bytes, Write write) {
  while (!bytes.empty()) {
    const ssize_t n = write(bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return EIO;  // no file takes nothing without a reason
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

/// A file that is made anew and grows by the bytes that are added. Each call throws EngineError with its path
/// and the system's reason.
class WrittenFile {
 public:
  explicit WrittenFile(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (file_ < 0) fail(errno);
  }
  ~WrittenFile() {
    if (file_ >= 0) ::close(file_);
  }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  void add(std::string_view bytes) {
    const int why =
        write_whole(bytes, [&](std::string_view rest) { return ::write(file_, rest.data(), rest.size()); });
    if (why != 0) fail(why);
  }
  /// Some file systems say only here that there was no space.
  void close() {
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0 && errno != EINTR) fail(errno);
  }

 private:
  [[noreturn]] void fail(int why) const {
    throw EngineError(path_ + ": cannot be written: " + std::strerror(why));
  }
  std::string path_;
  int file_;
};

}  // namespace tripoint
