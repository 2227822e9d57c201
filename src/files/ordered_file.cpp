// SPDX-License-Identifier: BSD-3-Clause
#include "files/ordered_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/written_file.hpp"

#if __has_include(<H5FDdevelop.h>)
#include <H5FDdevelop.h>
#endif

namespace tripoint::h5 {
namespace {

/// @return 0, or the errno of the call that failed; so do all that read and change files here
int write_all(int file, haddr_t at, const char* data, std::size_t size) {
  return write_whole({data, size}, [&](std::string_view rest) {
    const ssize_t n = ::pwrite(file, rest.data(), rest.size(), static_cast<off_t>(at));
    if (n > 0) at += static_cast<haddr_t>(n);
    return n;
  });
}

/// Bytes past the end of the file read as zeros, as HDF5 expects.
int read_all(int file, haddr_t at, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::pread(file, data, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) {
      std::memset(data, 0, size);
      return 0;
    }
    data += n;
    at += static_cast<haddr_t>(n);
    size -= static_cast<std::size_t>(n);
  }
  return 0;
}

/// Order of writes: 1. the superblock, which holds the end of the file; 2. index nodes, nearest to the root
/// first; 3. all other blocks, from the end of the file to its beginning. A dataset made first therefore
/// grows last. An early write of a node does no harm, because the old node still has the entries that it
/// hands over. (HDF5's format: a node begins with TREE, type, level.)
int rank_of(const std::pair<haddr_t, std::string>& block) {
  constexpr int first = 1000, last = -1;
  const std::string& bytes = block.second;
  if (block.first == 0) return first;
  if (bytes.size() > 5 && bytes.compare(0, 4, "TREE") == 0) return static_cast<unsigned char>(bytes[5]);
  return last;
}

/// A file of HDF5. Blocks where nothing lay at the last flush are written at once, since nothing leads to
/// them yet. Blocks that replace older bytes are held until the next flush. Once a change has failed there
/// are no more changes: the library's last writes, made to close the file, would lead into the gap.
class OrderedFile {
 public:
  OrderedFile(int file, haddr_t end) : file_(file), end_of_file_(end) {}
  ~OrderedFile() { ::close(file_); }
  OrderedFile(const OrderedFile&) = delete;
  OrderedFile& operator=(const OrderedFile&) = delete;

  int read(haddr_t at, char* data, std::size_t size) const {
    if (const int why = read_all(file_, at, data, size); why != 0) return why;
    for (auto block = first_beyond(held_, at); block != held_.end() && block->first < at + size; ++block) {
      const haddr_t from = std::max(at, block->first),
                    to = std::min(at + size, block->first + block->second.size());
      std::memcpy(data + (from - at), block->second.data() + (from - block->first), to - from);
    }
    return 0;
  }

  int write(bool is_raw, haddr_t at, const char* data, std::size_t size) {
    if (!is_raw && is_flushed(at, size)) {
      held_[at].assign(data, size);
      return 0;
    }
    if (!is_raw) fresh_[at] = size;
    if (change(at, data, size) != 0) return failure_;
    end_of_file_ = std::max<haddr_t>(end_of_file_, at + size);
    return 0;
  }

  int flush() {
    std::vector<std::pair<haddr_t, std::string>> blocks(std::make_move_iterator(held_.begin()),
                                                        std::make_move_iterator(held_.end()));
    held_.clear();
    std::sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) {
      return std::pair(rank_of(a), a.first) > std::pair(rank_of(b), b.first);
    });
    for (const auto& [at, bytes] : blocks)
      if (change(at, bytes.data(), bytes.size()) != 0) return failure_;
    flushed_.merge(fresh_);
    fresh_.clear();
    return 0;
  }

  /// A file must not be shorter than its superblock says, so that it grows before it is flushed and shrinks
  /// after.
  int set_length(haddr_t length) {
    if (length == end_of_file_) return 0;
    if (length < end_of_file_ && flush() != 0) return failure_;
    while (failure_ == 0 && ::ftruncate(file_, static_cast<off_t>(length)) != 0)
      failure_ = errno == EINTR ? 0 : errno;
    if (failure_ == 0) end_of_file_ = length;
    return failure_;
  }

  /// A block that could not be kept in memory is a gap as well.
  int give_up() {
    if (failure_ == 0) failure_ = ENOMEM;
    return failure_;
  }

  [[nodiscard]] int file() const { return file_; }
  [[nodiscard]] haddr_t end_of_file() const { return end_of_file_; }

 private:
  int change(haddr_t at, const char* data, std::size_t size) {
    if (failure_ == 0) failure_ = write_all(file_, at, data, size);
    return failure_;
  }

  /// The first block that ends beyond a place.
  template <class Map>
  static typename Map::const_iterator first_beyond(const Map& blocks, haddr_t at) {
    auto block = blocks.upper_bound(at);
    if (block == blocks.begin()) return block;
    const auto before = std::prev(block);
    return before->first + size_of(before->second) > at ? before : block;
  }
  static std::size_t size_of(const std::string& bytes) { return bytes.size(); }
  static std::size_t size_of(std::size_t size) { return size; }

  bool is_flushed(haddr_t at, std::size_t size) const {
    const auto block = first_beyond(flushed_, at);
    return block != flushed_.end() && block->first < at + size;
  }

  int file_;
  haddr_t end_of_file_;
  int failure_ = 0;                      ///< errno of the first change that failed
  std::map<haddr_t, std::string> held_;  ///< address -> bytes that replace older ones
  std::map<haddr_t, std::size_t> flushed_,
      fresh_;  ///< address -> size of blocks of the file's structure, before and since the last flush
};

/// HDF5's view of an open file; it fills in the first member.
struct Open {
  H5FD_t of_library;
  OrderedFile file;
  haddr_t end_of_space;
};

Open& own(H5FD_t* file) { return *reinterpret_cast<Open*>(file); }
const Open& own(const H5FD_t* file) { return *reinterpret_cast<const Open*>(file); }

/// Puts the reason for a failure where the library's own drivers put it, in their words. The caller of the
/// library finds it there.
void note_failure(int why) noexcept {
  H5Epush2(H5E_DEFAULT, __FILE__, "tripoint-ordered", __LINE__, H5E_ERR_CLS, H5E_IO, H5E_SYSERRSTR,
           "errno = %d, error message = '%s'", why, std::strerror(why));
}

/// No exception may pass through the library: where memory runs out the call fails, and the file changes no
/// more.
template <class Act>
herr_t carry_out(H5FD_t* file, Act act) noexcept {
  OrderedFile& own_file = own(file).file;
  int why = 0;
  try {
    why = act(own_file);
  } catch (const std::bad_alloc&) {
    why = own_file.give_up();
  }
  if (why == 0) return 0;
  note_failure(why);
  return -1;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t /*access*/, haddr_t /*greatest*/) {
  const int create = (flags & H5F_ACC_CREAT) != 0 ? O_CREAT : 0,
            truncate = (flags & H5F_ACC_TRUNC) != 0 ? O_TRUNC : 0;
  const int exclusive = (flags & H5F_ACC_EXCL) != 0 ? O_EXCL : 0,
            mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
  const int file = ::open(name, mode | create | truncate | exclusive | O_CLOEXEC, 0666);
  if (file < 0) {
    note_failure(errno);
    return nullptr;
  }
  struct stat status {};
  Open* made = ::fstat(file, &status) == 0 ? new (std::nothrow)
                                                 Open{{}, {file, static_cast<haddr_t>(status.st_size)}, 0}
                                           : nullptr;
  if (made == nullptr) {
    note_failure(errno);
    ::close(file);
    return nullptr;
  }
  return &made->of_library;
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<Open> until_flushed(&own(file));
  return carry_out(file, [](OrderedFile& open) { return open.flush(); });
}

/// By device and inode, as the library asks whether a file is open already.
int compare(const H5FD_t* one, const H5FD_t* other) {
  struct stat a {
  }, b{};
  ::fstat(own(one).file.file(), &a);
  ::fstat(own(other).file.file(), &b);
  if (a.st_dev != b.st_dev) return a.st_dev < b.st_dev ? -1 : 1;
  return a.st_ino == b.st_ino ? 0 : a.st_ino < b.st_ino ? -1 : 1;
}

/// Without the library's joining of neighbouring writes of structure: each comes alone, and its kind can be
/// told.
herr_t features(const H5FD_t* /*file*/, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA |
           H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_space(const H5FD_t* file, H5FD_mem_t /*kind*/) { return own(file).end_of_space; }

herr_t set_end_of_space(H5FD_t* file, H5FD_mem_t /*kind*/, haddr_t end) {
  own(file).end_of_space = end;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t /*kind*/) { return own(file).file.end_of_file(); }

herr_t read_file(H5FD_t* file, H5FD_mem_t /*kind*/, hid_t /*transfer*/, haddr_t at, std::size_t size,
                 void* data) {
  return carry_out(file, [&](OrderedFile& open) { return open.read(at, static_cast<char*>(data), size); });
}

herr_t write_file(H5FD_t* file, H5FD_mem_t kind, hid_t /*transfer*/, haddr_t at, std::size_t size,
                  const void* data) {
  return carry_out(file, [&](OrderedFile& open) {
    return open.write(kind == H5FD_MEM_DRAW, at, static_cast<const char*>(data), size);
  });
}

herr_t flush_file(H5FD_t* file, hid_t /*transfer*/, hbool_t /*is_closing*/) {
  return carry_out(file, [](OrderedFile& open) { return open.flush(); });
}

herr_t set_length(H5FD_t* file, hid_t /*transfer*/, hbool_t /*is_closing*/) {
  return carry_out(file, [&](OrderedFile& open) { return open.set_length(own(file).end_of_space); });
}

hid_t registered_driver() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(512);  // of those that the library leaves to others
#endif
  driver.name = "tripoint-ordered";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = features;
  driver.get_eoa = end_of_space;
  driver.set_eoa = set_end_of_space;
  driver.get_eof = end_of_file;
  driver.read = read_file;
  driver.write = write_file;
  driver.flush = flush_file;
  driver.truncate = set_length;
  const H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), driver.fl_map);
  return H5FDregister(&driver);
}

}  // namespace

void write_in_order(hid_t access) {
  static const hid_t driver = registered_driver();
  if (driver < 0 || H5Pset_driver(access, driver, nullptr) < 0)
    throw EngineError("HDF5 takes no driver for files of its own order");
}

}  // namespace tripoint::h5
