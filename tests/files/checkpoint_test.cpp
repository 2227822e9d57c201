// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "core/errors.hpp"
#include "files/checkpoint_file.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

struct CheckpointFile : ::testing::Test {
  CheckpointFile()
      : folder(fs::temp_directory_path() / ("tripoint checkpoints " + std::to_string(::getpid()))) {
    fs::create_directories(folder);
  }
  ~CheckpointFile() override { fs::remove_all(folder); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  fs::path folder;
};

Checkpoint example_checkpoint(std::size_t rows = 200, double scale = 1.0) {
  Checkpoint c;
  for (std::size_t i = 0; i < rows; ++i)
    c.real["particles/position.x"].push_back(scale * std::sqrt(static_cast<double>(i)));
  c.real["step/time"] = {0.1, -0.0, std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 5e-324};
  c.real["step/none"] = {};
  c.real["good/older/particles/mass"] = {1.0, 2.0};  // a state within the state
  c.whole["particles/id"] = {0, -1, std::numeric_limits<std::int64_t>::max()};
  c.text["bodies/name"] = {"a", "", "größer / than"};
  return c;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST_F(CheckpointFile, ReadsBackBitForBit) {
  write_checkpoint(path("c.h5"), example_checkpoint());
  EXPECT_TRUE(same_bits(read_checkpoint(path("c.h5")), example_checkpoint()));
  EXPECT_FALSE(same_bits(read_checkpoint(path("c.h5")), example_checkpoint(200, 1.0 + 1e-16 * 4)));
  EXPECT_FALSE(fs::exists(path("c.h5.part")));
}

TEST_F(CheckpointFile, WithAnyBitFlippedIsRefusedByName) {
  write_checkpoint(path("c.h5"), example_checkpoint(20));
  const std::string whole = bytes_of(path("c.h5"));
  std::mt19937 random(1);
  for (int n = 0; n < 500; ++n) {
    std::string torn = whole;
    const std::size_t at = random() % torn.size();
    torn[at] = static_cast<char>(torn[at] ^ (1 << random() % 8));
    put(path("flipped.h5"), torn);
    try {
      (void)read_checkpoint(path("flipped.h5"));
      ADD_FAILURE() << "byte " << at << " of " << whole.size();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("flipped.h5"), std::string::npos);
    }
  }
}

TEST_F(CheckpointFile, CutAnywhereIsRefusedByName) {
  write_checkpoint(path("c.h5"), example_checkpoint(20));
  const std::string whole = bytes_of(path("c.h5"));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 300) {
    put(path("cut.h5"), whole.substr(0, size));
    EXPECT_THROW((void)read_checkpoint(path("cut.h5")), InputError) << size << " of " << whole.size();
  }
  EXPECT_THROW((void)read_checkpoint(path("absent.h5")), InputError);
  EXPECT_THROW((void)read_checkpoint(folder.string()), InputError);
}

TEST_F(CheckpointFile, OfAnotherVersionIsRefusedAsSuch) {
  write_checkpoint(path("c.h5"), example_checkpoint(20));
  std::string other = bytes_of(path("c.h5"));
  other[other.find('1')] = '2';  // "tripoint checkpoint 1"
  put(path("c.h5"), other);
  try {
    (void)read_checkpoint(path("c.h5"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("another version"), std::string::npos) << e.what();
  }
}

TEST_F(CheckpointFile, WhoseWriterIsKilledLeavesTheEarlierOne) {
  const Checkpoint early = example_checkpoint(), late = example_checkpoint(200000, 2.0);
  int interrupted = 0;
  for (int delay = 0; delay < 60; ++delay) {
    write_checkpoint(path("c.h5"), early);
    const pid_t child = ::fork();
    if (child == 0) {
      write_checkpoint(path("c.h5"), late);
      ::_exit(0);
    }
    ::usleep(static_cast<useconds_t>(delay * 400));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    const Checkpoint found = read_checkpoint(path("c.h5"));
    const bool old = same_bits(found, early);
    EXPECT_TRUE(old || same_bits(found, late)) << "killed after " << delay * 0.4 << " ms";
    interrupted += old && fs::exists(path("c.h5.part"));
  }
  EXPECT_GT(interrupted, 0) << "no writer was killed while it wrote: the test proves nothing";
}

TEST_F(CheckpointFile, ThatCannotBeWrittenIsAnErrorThatNamesIt) {
  try {
    write_checkpoint(path("no such folder/c.h5"), example_checkpoint());
    FAIL();
  } catch (const EngineError& e) {
    EXPECT_NE(std::string(e.what()).find("c.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace tripoint
