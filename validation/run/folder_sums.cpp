// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/folder_sums.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

namespace tripoint {
namespace {

constexpr int deepest = 64;

struct Closes {
  void operator()(DIR* folder) const { ::closedir(folder); }
};
using Folder = std::unique_ptr<DIR, Closes>;

/// A folder below an open one, never through a link; null where it cannot be opened.
Folder open_folder(int above, const char* name) {
  const int fd = ::openat(above, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return nullptr;
  Folder folder(::fdopendir(fd));
  if (!folder) ::close(fd);
  return folder;
}

/// Calls with the name of each entry until it says no.
template <class Use>
void each_entry(DIR* folder, Use use) {
  while (const dirent* entry = ::readdir(folder)) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != ".." && !use(entry->d_name)) return;
  }
}

void add_folder(DIR* folder, int depth, std::size_t enough, FolderSums& sums) {
  if (depth > deepest) {
    sums.unseen = fmt::format("folders more than {} deep", deepest);
    return;
  }
  each_entry(folder, [&](const char* name) {
    struct stat status {};
    if (::fstatat(::dirfd(folder), name, &status, AT_SYMLINK_NOFOLLOW) != 0) return true;  // gone meanwhile
    sums.bytes += 512.0 * static_cast<double>(status.st_blocks);
    ++sums.entries;
    if (S_ISDIR(status.st_mode)) {
      if (const Folder inner = open_folder(::dirfd(folder), name))
        add_folder(inner.get(), depth + 1, enough, sums);
      else if (errno == EACCES)
        sums.unseen = "a folder that is closed to us";
    }
    return sums.entries <= enough && sums.unseen.empty();
  });
}

/// Removes the files of a folder, and moves its folders into another one, where each has a number.
void empty_into(int heap, DIR* folder, std::size_t& moved, const std::set<std::string>& kept = {}) {
  each_entry(folder, [&](const char* name) {
    if (kept.contains(name) || ::unlinkat(::dirfd(folder), name, 0) == 0) return true;
    // A folder that is closed to us cannot be moved
    return ::fchmodat(::dirfd(folder), name, S_IRWXU, AT_SYMLINK_NOFOLLOW) != 0 ||
           ::renameat(::dirfd(folder), name, heap, std::to_string(++moved).c_str()) == 0;
  });
}

/// @return how many folders it removed from the heap; new ones may have come
std::size_t remove_once(DIR* heap, std::size_t& moved) {
  std::size_t removed = 0;
  ::rewinddir(heap);
  each_entry(heap, [&](const char* name) {
    if (const Folder inner = open_folder(::dirfd(heap), name)) empty_into(::dirfd(heap), inner.get(), moved);
    if (::unlinkat(::dirfd(heap), name, AT_REMOVEDIR) == 0) ++removed;
    return true;
  });
  return removed;
}

}  // namespace

FolderSums sums_of_folder(const std::string& folder, std::size_t enough) {
  FolderSums sums;
  if (const Folder opened = open_folder(AT_FDCWD, folder.c_str())) add_folder(opened.get(), 0, enough, sums);
  return sums;
}

void remove_flat(const std::string& folder, std::set<std::string> kept) {
  std::string heap = folder + "/.removed-XXXXXX";
  if (!::mkdtemp(heap.data())) return;
  const Folder opened = open_folder(AT_FDCWD, folder.c_str()), into = open_folder(AT_FDCWD, heap.c_str());
  if (!opened || !into) return;
  std::size_t moved = 0;
  kept.insert(heap.substr(folder.size() + 1));
  empty_into(::dirfd(into.get()), opened.get(), moved, kept);
  while (remove_once(into.get(), moved) > 0) {
  }
  ::rmdir(heap.c_str());
}

}  // namespace tripoint
