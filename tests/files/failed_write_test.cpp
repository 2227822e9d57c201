// SPDX-License-Identifier: BSD-3-Clause
// What a full disk, a broken one, one that is read only and a used-up quota each make a file say.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>

#include "core/errors.hpp"
#include "files/checkpoint_file.hpp"
#include "files/trajectory.hpp"
#include "files/write_calls.hpp"

namespace tripoint {
namespace {

constexpr std::array reasons{ENOSPC, EIO, EROFS, EDQUOT};

struct FailedWrite : ::testing::Test {
  FailedWrite()
      : folder(std::filesystem::temp_directory_path() /
               ("tripoint errno = 1 " + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~FailedWrite() override {
    let_writes_fail(0);
    std::filesystem::remove_all(folder);
  }
  static void let_writes_fail(int why, bool only_first_bytes = false) {
    test::write_error = why;
    test::only_first_bytes = only_first_bytes;
    test::calls_until_failure = -1;
  }
  /// Lets each write of a deed fail alone, one after the other. @return how many there are
  static int expect_reason_of_each_write(int why, const std::function<void()>& deed);
  [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
  std::filesystem::path folder;
};

/// What a deed says that ends with an EngineError.
std::string words_of(const std::function<void()>& deed) {
  try {
    deed();
  } catch (const EngineError& e) {
    return e.what();
  }
  return "it did not fail";
}

void expect_reason(const std::string& words, int why) {
  EXPECT_NE(words.find(std::strerror(why)), std::string::npos) << words;
  EXPECT_TRUE(why == ENOSPC || words.find("space") == std::string::npos) << words;
}

int FailedWrite::expect_reason_of_each_write(int why, const std::function<void()>& deed) {
  for (int n = 0;; ++n) {
    let_writes_fail(why);
    test::calls_until_failure = n;
    const std::string words = words_of(deed);
    const bool has_failed = test::write_error == 0;
    let_writes_fail(0);
    if (!has_failed) return n;
    SCOPED_TRACE("write " + std::to_string(n));
    expect_reason(words, why);
  }
}

Snapshot one_particle(double time) {
  Snapshot s;
  s.time = time;
  s.position = s.velocity = {{time, 0.0, 0.0}};
  s.mass = {1.0};
  return s;
}

Checkpoint of_many_rows() {
  Checkpoint kept;
  kept.real["particles/mass"].assign(1000, 2.0);
  return kept;
}

TEST_F(FailedWrite, OfAFrameSaysTheReasonOfTheSystem) {
  for (const int why : reasons) {
    TrajectoryWriter writer(path("trajectory.h5"));
    writer.append(one_particle(0.0));
    let_writes_fail(why);
    expect_reason(words_of([&] { writer.append(one_particle(1.0)); }), why);
    expect_reason(words_of([&] { writer.append(one_particle(2.0)); }), why);  // the gap is still there
    let_writes_fail(0);
    expect_reason(words_of([&] { writer.append(one_particle(3.0)); }), why);
  }
}

TEST_F(FailedWrite, OfACheckpointSaysTheReasonOfTheSystem) {
  for (const int why : reasons) {
    let_writes_fail(why);
    expect_reason(words_of([&] { write_checkpoint(path("c.h5"), of_many_rows()); }), why);
    let_writes_fail(0);
  }
}

TEST_F(FailedWrite, OfTheSealOfACheckpointSaysTheReasonOfTheSystem) {
  for (const int why : reasons) {
    let_writes_fail(why, true);
    const std::string words = words_of([&] { write_checkpoint(path("c.h5"), of_many_rows()); });
    let_writes_fail(0);
    expect_reason(words, why);
    EXPECT_NE(words.find("c.h5.part"), std::string::npos) << words;
  }
}

TEST_F(FailedWrite, WhicheverItIsSaysTheReasonOfTheSystem) {
  EXPECT_GT(expect_reason_of_each_write(EIO, [&] { write_checkpoint(path("c.h5"), of_many_rows()); }), 3);
  InitialState s;
  s.position = s.velocity = {{}};
  s.mass = {1.0};
  s.phase = s.body = s.material = s.source = {0};
  EXPECT_GT(expect_reason_of_each_write(EIO, [&] { write_particles(path("particles.h5"), s); }), 100);
}

TEST_F(FailedWrite, OfAFileThatCannotBeMadeSaysTheReasonOfTheSystem) {
  expect_reason(words_of([&] { TrajectoryWriter writer(path("no such folder/trajectory.h5")); }), ENOENT);
  expect_reason(words_of([&] { write_checkpoint(path("no such folder/c.h5"), of_many_rows()); }), ENOENT);
  expect_reason(words_of([&] { write_xdmf(path("no such folder"), {0.0}, one_particle(0.0)); }), ENOENT);
  std::filesystem::create_directory(path("c.h5.part"));
  expect_reason(words_of([&] { write_checkpoint(path("c.h5"), of_many_rows()); }), EISDIR);
}

}  // namespace
}  // namespace tripoint
