// SPDX-License-Identifier: BSD-3-Clause
// Calls on files: those that change one or its name, remove one, open or read one.
#include <stdio.h>
#include <sys/stat.h>
#include <sys/uio.h>

#include <cerrno>
#include <cstdarg>

#include "faults/seam.hpp"

namespace fault_seam {
namespace {

/// A write of `count` bytes at a place. @param call writes so many of them
template <class Call>
ssize_t write_by(int fd, off_t at, size_t count, Call call) {
  if (!plan().meant) return call(count);
  const std::lock_guard lock(plan().mutex);
  const std::string path = path_of(fd);
  const Fate f = fate(Set::files, "write", path);
  if (f == Fate::fails) return -1;
  if (path.starts_with(plan().folder)) remember_bytes(path, at, count);
  const bool in_part = f == Fate::half_and_on || f == Fate::half_and_dies;
  const ssize_t done = call(in_part && count > 1 ? count / 2 : count);
  if (f == Fate::half_and_dies || f == Fate::done_and_dies) die();
  return done;
}

/// A read of up to `count` bytes. It may wait, so that nothing is held meanwhile. @param call reads so many
/// of them
template <class Call>
ssize_t read_by(int fd, size_t count, Call call) {
  if (!plan().meant) return call(count);
  const Fate f = [&] {
    const std::lock_guard lock(plan().mutex);
    const std::string path = path_of(fd);
    return fate(path.starts_with('/') ? Set::read : Set::stream, "read", path);
  }();
  if (f == Fate::fails) return -1;
  if (f == Fate::half_and_dies) die();
  const ssize_t done = call(f == Fate::half_and_on && count > 1 ? count / 2 : count);
  if (f == Fate::done_and_dies) die();
  return done;
}

template <class Call>
int open_by(const char* path, int flags, Call call) {
  if (!plan().meant) return call();
  const std::string name = absolute(path);
  if ((flags & O_ACCMODE) == O_RDONLY) return whole(Set::read, "open", name, call);
  return whole(Set::files, "open", name, [&] {
    const off_t size = size_of(name);
    const bool counts = plan().loses && name.starts_with(plan().folder);
    if (counts && size >= 0 && (flags & O_TRUNC)) remember_bytes(name, 0, static_cast<size_t>(size));
    const int fd = call();
    if (counts && size < 0 && fd >= 0) remember_made(name);
    return fd;
  });
}

/// A file or folder goes.
template <class Call>
int remove_by(const char* operation, const std::string& name, Call call) {
  return whole(Set::name, operation, name, [&] {
    struct stat about {};
    const bool counts = plan().loses && name.starts_with(plan().folder) && lstat(name.c_str(), &about) == 0;
    const bool is_file = S_ISREG(about.st_mode), is_folder = S_ISDIR(about.st_mode);
    std::string bytes = counts && is_file ? bytes_at(name, 0, static_cast<size_t>(about.st_size)) : "";
    const int result = call();
    if (counts && result == 0 && (is_file || is_folder))
      plan().unsynced.push_back(
          {Unsynced::What::removed, name, "", 0, about.st_size, std::move(bytes), is_folder, 0, {}});
    return result;
  });
}

template <class Call>
int make_folder_by(const std::string& name, Call call) {
  return whole(Set::name, "mkdir", name, [&] {
    const int result = call();
    if (plan().loses && result == 0 && name.starts_with(plan().folder)) remember_made(name);
    return result;
  });
}

/// Path of a file that is named from an open folder on.
std::string path_from(int folder, const char* path) {
  return *path == '/' || folder == AT_FDCWD ? absolute(path) : path_of(folder) + "/" + path;
}

int mode_of(int flags, va_list rest) { return flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, int) : 0; }

}  // namespace
}  // namespace fault_seam

using namespace fault_seam;

extern "C" {

ssize_t read(int fd, void* data, size_t n) {
  NEXT(read);
  return read_by(fd, n, [&](size_t some) { return next(fd, data, some); });
}

ssize_t pread(int fd, void* data, size_t n, off_t at) {
  NEXT(pread);
  return read_by(fd, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t pread64(int fd, void* data, size_t n, off64_t at) { return pread(fd, data, n, at); }

// What a build with _FORTIFY_SOURCE calls instead.
ssize_t __read_chk(int fd, void* data, size_t n, size_t /*most*/) { return read(fd, data, n); }
ssize_t __pread_chk(int fd, void* data, size_t n, off_t at, size_t /*most*/) {
  return pread(fd, data, n, at);
}
ssize_t __pread64_chk(int fd, void* data, size_t n, off64_t at, size_t /*most*/) {
  return pread(fd, data, n, at);
}
int __open_2(const char* path, int flags) { return open(path, flags); }
int __open64_2(const char* path, int flags) { return open(path, flags); }

ssize_t write(int fd, const void* data, size_t n) {
  NEXT(write);
  return write_by(fd, static_cast<off_t>(raw(SYS_lseek, fd, 0, SEEK_CUR)), n,
                  [&](size_t some) { return next(fd, data, some); });
}

ssize_t pwrite(int fd, const void* data, size_t n, off_t at) {
  NEXT(pwrite);
  return write_by(fd, at, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t pwrite64(int fd, const void* data, size_t n, off64_t at) {
  NEXT(pwrite64);
  return write_by(fd, at, n, [&](size_t some) { return next(fd, data, some, at); });
}

ssize_t writev(int fd, const iovec* parts, int n) {
  NEXT(write);
  std::string all;
  for (int k = 0; k < n; ++k) all.append(static_cast<const char*>(parts[k].iov_base), parts[k].iov_len);
  return write_by(fd, static_cast<off_t>(raw(SYS_lseek, fd, 0, SEEK_CUR)), all.size(),
                  [&](size_t some) { return next(fd, all.data(), some); });
}

int ftruncate(int fd, off_t size) {
  NEXT(ftruncate);
  if (!plan().meant) return next(fd, size);
  const std::string path = path_of(fd);
  return whole(Set::files, "cut", path, [&] {
    const off_t before = size_of(path);
    if (before > size)
      remember_bytes(path, size, static_cast<size_t>(before - size));
    else
      remember_bytes(path, before, 0);
    return next(fd, size);
  });
}

int ftruncate64(int fd, off64_t size) { return ftruncate(fd, size); }

int fsync(int fd) {
  NEXT(fsync);
  if (!plan().meant) return next(fd);
  const std::string path = path_of(fd);
  return whole(Set::files, "fsync", path, [&] {
    made_durable(path);
    return 0;  // the disk itself is not what is tested, and is slow
  });
}

int fdatasync(int fd) { return fsync(fd); }

int rename(const char* from, const char* to) {
  NEXT(rename);
  if (!plan().meant) return next(from, to);
  const std::string old_name = absolute(from), name = absolute(to);
  return whole(Set::files, "rename", name, [&] {
    const off_t size = size_of(name);
    Unsynced u{Unsynced::What::renamed,
               name,
               old_name,
               0,
               size,
               plan().loses && size > 0 ? bytes_at(name, 0, static_cast<size_t>(size)) : "",
               size >= 0,
               ++plan().renames,
               {}};
    const int result = next(from, to);
    if (!plan().loses || result != 0) return result;
    for (Unsynced& earlier : plan().unsynced) {
      if (earlier.path != old_name) continue;
      earlier.former.emplace_back(u.rename, old_name);
      earlier.path = name;
    }
    plan().unsynced.push_back(std::move(u));
    return result;
  });
}

int open(const char* path, int flags, ...) {
  NEXT(open);
  va_list rest;
  va_start(rest, flags);
  const int mode = mode_of(flags, rest);
  va_end(rest);
  return open_by(path, flags, [&] { return next(path, flags, mode); });
}

int open64(const char* path, int flags, ...) {
  NEXT(open64);
  va_list rest;
  va_start(rest, flags);
  const int mode = mode_of(flags, rest);
  va_end(rest);
  return open_by(path, flags, [&] { return next(path, flags, mode); });
}

FILE* fopen(const char* path, const char* how) {
  NEXT(fopen);
  FILE* file = nullptr;
  const int flags = *how == 'r' ? O_RDONLY : *how == 'w' ? O_WRONLY | O_TRUNC : O_WRONLY;
  return open_by(path, flags, [&] { return (file = next(path, how)) ? 0 : -1; }) == 0 ? file : nullptr;
}

FILE* fopen64(const char* path, const char* how) { return fopen(path, how); }

int unlink(const char* path) noexcept {
  NEXT(unlink);
  return plan().meant ? remove_by("unlink", absolute(path), [&] { return next(path); }) : next(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  NEXT(unlinkat);
  const auto call = [&] { return next(folder, path, flags); };
  return plan().meant ? remove_by("unlink", path_from(folder, path), call) : call();
}

int rmdir(const char* path) noexcept {
  NEXT(rmdir);
  return plan().meant ? remove_by("rmdir", absolute(path), [&] { return next(path); }) : next(path);
}

int remove(const char* path) noexcept {
  NEXT(remove);
  return plan().meant ? remove_by("remove", absolute(path), [&] { return next(path); }) : next(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  NEXT(mkdir);
  return plan().meant ? make_folder_by(absolute(path), [&] { return next(path, mode); }) : next(path, mode);
}

int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  NEXT(mkdirat);
  const auto call = [&] { return next(folder, path, mode); };
  return plan().meant ? make_folder_by(path_from(folder, path), call) : call();
}
}
