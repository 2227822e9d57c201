// SPDX-License-Identifier: BSD-3-Clause
// A process may be killed between any two calls that change its trajectory: the calls are recorded here, and
// what the file held after each is looked at.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "files/h5md_file.hpp"
#include "files/trajectory.hpp"
#include "files/write_calls.hpp"

namespace {

/// One call that changes a file: bytes at a place, or a new length where there are none.
struct Change {
  off_t at = 0;
  std::string bytes;
  bool is_length = false;
};

bool is_recording = false;
std::vector<Change> changes;

/// Whether a call is to fail; errno then says why.
bool fails(off_t at) {
  using namespace tripoint::test;
  if (write_error == 0 || (only_first_bytes && at != 0)) return false;
  const int why = write_error;
  if (calls_until_failure > 0) {
    --calls_until_failure;
    return false;
  }
  if (calls_until_failure == 0) write_error = 0;
  errno = why;
  return true;
}

ssize_t recorded_write(int file, const void* data, size_t size, off_t at) {
  if (fails(at)) return -1;
  if (is_recording) changes.push_back({at, {static_cast<const char*>(data), size}});
  return syscall(SYS_pwrite64, file, data, size, at);
}

int recorded_length(int file, off_t size) {
  if (fails(size)) return -1;
  if (is_recording) changes.push_back({size, {}, true});
  return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

}  // namespace

extern "C" {  // in place of the C library's, for libhdf5 too
ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  return recorded_write(file, data, size, at);
}
ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  return recorded_write(file, data, size, at);
}
int ftruncate(int file, off_t size) noexcept { return recorded_length(file, size); }
int ftruncate64(int file, off64_t size) noexcept { return recorded_length(file, size); }
}

namespace tripoint {
namespace {

Snapshot two_particles(int frame) {
  Snapshot s;
  s.time = 0.5 * frame;
  s.step = frame;
  s.position = {{1.0 * frame, 0.0, 0.0}, {0.0, 0.25 * frame, 1.0}};
  s.velocity = {{0.0, -1.0 * frame, 0.0}, {0.0, 0.0, 2.0}};
  s.mass = {1.0, 2.0};
  return s;
}

/// What a trajectory of some frames went through.
struct Recorded {
  std::vector<Change> all;
  std::vector<std::size_t> after;  ///< frame -> changes done when it was announced
};

Recorded recorded(const std::string& path, int frames) {
  changes.clear();
  is_recording = true;
  Recorded found;
  TrajectoryWriter writer(path);
  for (int f = 0; f < frames; ++f) {
    writer.append(two_particles(f));
    found.after.push_back(changes.size());
  }
  writer.close();
  is_recording = false;
  found.all = std::move(changes);
  return found;
}

void apply(int file, const Change& change) {
  if (change.is_length)
    ASSERT_EQ(syscall(SYS_ftruncate, file, change.at), 0);
  else
    ASSERT_EQ(syscall(SYS_pwrite64, file, change.bytes.data(), change.bytes.size(), change.at),
              static_cast<ssize_t>(change.bytes.size()));
}

/// Announced frames that are there with their bits.
std::size_t whole_frames(const std::string& path, std::size_t announced) {
  const Trajectory there = read_trajectory(path);
  std::size_t whole = 0;
  while (whole < std::min(announced, there.frames.size()) &&
         state_hash(there.frames[whole]) == state_hash(two_particles(static_cast<int>(whole))))
    ++whole;
  return whole;
}

/// The same by positions alone: thousands of frames are read many times.
std::size_t whole_positions(const std::string& path, std::size_t announced) {
  const h5::Handle file = h5::open_for_reading(path);
  const std::vector<double> there = h5::read_real(file.get(), "/particles/all/position/value", path).real;
  std::size_t whole = 0;
  while (whole < announced && 6 * whole + 4 < there.size() &&
         there[6 * whole] == 1.0 * static_cast<double>(whole) &&
         there[6 * whole + 4] == 0.25 * static_cast<double>(whole))
    ++whole;
  return whole;
}

using WholeFrames = std::size_t(const std::string& path, std::size_t announced);

/// Looks at the file after each change of what it held before, from when `first` frames are announced until
/// `last` are. @return how often it looked
int look_after_each_change(const std::string& path, const Recorded& written, std::size_t first,
                           std::size_t last, WholeFrames& whole) {
  const int file = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  std::size_t announced = 0;
  int looked = 0;
  off_t length = 0;
  for (std::size_t k = 0; k < written.all.size(); ++k) {
    const Change& change = written.all[k];
    apply(file, change);
    const bool is_addition = !change.is_length && change.at >= length;
    length = change.is_length ? change.at
                              : std::max<off_t>(length, change.at + static_cast<off_t>(change.bytes.size()));
    while (announced < written.after.size() && written.after[announced] <= k + 1) ++announced;
    if (announced < first) continue;
    if (announced >= last) break;
    if (is_addition) continue;
    ++looked;
    std::size_t kept = 0;
    EXPECT_NO_THROW(kept = whole(path, announced)) << "after change " << k;
    EXPECT_EQ(kept, announced) << "after change " << k;
    if (::testing::Test::HasFailure()) break;
  }
  ::close(file);
  return looked;
}

struct DeathInAWrite : ::testing::Test {
  DeathInAWrite()
      : folder(std::filesystem::temp_directory_path() / ("tripoint death " + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~DeathInAWrite() override { std::filesystem::remove_all(folder); }
  std::filesystem::path folder;
};

TEST_F(DeathInAWrite, TakesNoAnnouncedFrameOfTheFirst) {
  const Recorded written = recorded(folder / "written.h5", 3);
  EXPECT_GT(look_after_each_change(folder / "torn.h5", written, 1, 4, whole_frames), 20);
}

// The index of a dataset's chunks holds 64 of them in a node: the 65th frame splits it, and later ones every
// 57 frames.
TEST_F(DeathInAWrite, TakesNoAnnouncedFrameWhileAnIndexIsSplit) {
  const Recorded written = recorded(folder / "written.h5", 124);
  EXPECT_GT(look_after_each_change(folder / "torn.h5", written, 63, 67, whole_frames), 40);
  EXPECT_GT(look_after_each_change(folder / "torn again.h5", written, 120, 124, whole_frames), 40);
}

// After 64 such nodes the root of the index is split as well.
TEST_F(DeathInAWrite, TakesNoAnnouncedFrameWhileTheRootOfAnIndexIsSplit) {
  const int split = 64 * 57 + 7;
  const Recorded written = recorded(folder / "written.h5", split + 2);
  EXPECT_GT(look_after_each_change(folder / "torn.h5", written, split, split + 1, whole_positions), 10);
}

}  // namespace
}  // namespace tripoint
