// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "core/errors.hpp"

namespace tripoint {

/// From now on the contents of a file, or the names in a folder, survive a loss of power. @throws EngineError
/// naming it and the system's reason
inline void make_durable(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool safe = file >= 0 && ::fsync(file) == 0;
  const int why = errno;
  if (file >= 0) ::close(file);
  if (!safe) throw EngineError(path + ": cannot be made durable: " + std::strerror(why));
}

/// Writes a file so that a reader finds the old contents or all of the new: temporary name, fsync, rename,
/// fsync of the folder. A link or pipe that somebody has left under the temporary name is removed and not
/// followed.
/// @throws EngineError naming the file and the system's reason
inline void write_durably(const std::string& path, std::string_view text) {
  const std::string temporary = path + ".part";
  const auto slash = path.find_last_of('/');
  const std::string folder_name = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  // Nothing below the rename asks for memory: where there was none, the file would be whole and the call
  // would have failed.
  const auto fail = [&] { throw EngineError(path + ": cannot be written: " + std::strerror(errno)); };
  ::unlink(temporary.c_str());
  const int file = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0644);
  if (file < 0) fail();
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t n = ::write(file, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      ::close(file);
      ::unlink(temporary.c_str());
      fail();
    }
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  if (::fsync(file) != 0) fail();
  ::close(file);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail();
  const int folder = ::open(folder_name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

}  // namespace tripoint
