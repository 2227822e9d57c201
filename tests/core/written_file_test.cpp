// SPDX-License-Identifier: BSD-3-Clause
#include "core/written_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace tripoint {
namespace {

std::string words_of_writing(const std::string& path) {
  try {
    WrittenFile file(path);
    file.add("text");
    file.close();
  } catch (const EngineError& e) {
    return e.what();
  }
  return "it did not fail";
}

TEST(WrittenFile, ThatCannotBeWrittenSaysTheReasonOfTheSystem) {
  EXPECT_EQ(words_of_writing("/dev/full"), "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(words_of_writing("/no/such/folder/f"),
            "/no/such/folder/f: cannot be written: No such file or directory");
  EXPECT_EQ(words_of_writing("/"), "/: cannot be written: Is a directory");
}

TEST(WrittenFile, HoldsWhatWasAddedAndNothingOfBefore) {
  const auto path =
      std::filesystem::temp_directory_path() / ("tripoint written " + std::to_string(::getpid()));
  std::ofstream(path) << "something longer than what follows";
  WrittenFile file(path);
  file.add("one ");
  file.add("two");
  file.close();
  std::string text;
  std::getline(std::ifstream(path), text);
  std::filesystem::remove(path);
  EXPECT_EQ(text, "one two");
}

TEST(WriteWhole, GoesOnAfterAPartAndAnInterruptionAndKeepsTheReasonOfAFailure) {
  std::vector<std::string> calls;
  const auto by_threes = [&](std::string_view rest) -> ssize_t {
    calls.emplace_back(rest);
    if (calls.size() == 2) {
      errno = EINTR;
      return -1;
    }
    return static_cast<ssize_t>(std::min<std::size_t>(3, rest.size()));
  };
  EXPECT_EQ(write_whole("abcdefgh", by_threes), 0);
  EXPECT_EQ(calls, (std::vector<std::string>{"abcdefgh", "defgh", "defgh", "gh"}));
  const auto fails = [](std::string_view) -> ssize_t {
    errno = EDQUOT;
    return -1;
  };
  EXPECT_EQ(write_whole("abc", fails), EDQUOT);
}

}  // namespace
}  // namespace tripoint
