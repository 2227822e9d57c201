// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/folder_lock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "core/errors.hpp"
#include "harness/fakes.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

/// What who wants the folder is told; empty where he gets it.
std::string refusal(const std::string& folder) {
  try {
    const FolderLock lock(folder);
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A process that does this and then waits until it is killed.
template <class Deed>
pid_t started(Deed deed) {
  int ends[2];
  if (::pipe(ends) != 0) return -1;
  const pid_t child = ::fork();
  if (child == 0) {
    deed([&] { static_cast<void>(::write(ends[1], "x", 1) == 1); });
    ::_exit(1);
  }
  ::close(ends[1]);
  char word = 0;
  EXPECT_EQ(::read(ends[0], &word, 1), 1) << "it ended early";
  ::close(ends[0]);
  return child;
}

void kill_and_wait(pid_t child) {
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST(FolderLock, KeepsASecondCallOutAndSaysWhoHoldsIt) {
  const TestFolder one, other;
  std::optional<FolderLock> lock(one / "");
  const std::string words = refusal(one / "");
  EXPECT_NE(words.find(fmt::format("process {} ", ::getpid())), std::string::npos) << words;
  EXPECT_NE(words.find("--out"), std::string::npos) << words;
  EXPECT_EQ(refusal(other / ""), "");
  lock.reset();
  EXPECT_EQ(refusal(one / ""), "");
  EXPECT_TRUE(fs::exists(one / ".lock")) << "who takes it away lets two others have one each";
}

TEST(FolderLock, IsFreeOnceItsHolderIsKilled) {
  const TestFolder folder;
  const pid_t holder = started([&](auto ready) {
    const FolderLock lock(folder / "");
    ready();
    for (;;) ::pause();
  });
  EXPECT_NE(refusal(folder / "").find(fmt::format("process {} ", holder)), std::string::npos);
  kill_and_wait(holder);
  EXPECT_EQ(refusal(folder / ""), "");
}

TEST(FolderLock, IsNotHeldByACopyOfItsHolder) {
  const TestFolder folder;
  std::optional<FolderLock> lock(folder / "");
  const pid_t copy = started([](auto ready) {
    ready();
    for (;;) ::pause();
  });
  EXPECT_NE(refusal(folder / ""), "") << "the copy has given up what is ours";
  lock.reset();
  EXPECT_EQ(refusal(folder / ""), "");
  kill_and_wait(copy);
}

TEST(FolderLock, IsNotHandedToAProgramThatIsStarted) {
  const TestFolder folder;
  const FolderLock lock(folder / "");
  FILE* const open_files = ::popen("ls -l /proc/self/fd", "r");
  ASSERT_NE(open_files, nullptr);
  std::array<char, 4096> text{};
  const std::size_t n = std::fread(text.data(), 1, text.size() - 1, open_files);
  ::pclose(open_files);
  EXPECT_GT(n, 0u);
  EXPECT_EQ(std::string(text.data()).find(".lock"), std::string::npos) << text.data();
}

TEST(FolderLock, WritesIntoNoFileOfSomebodyElse) {
  const TestFolder folder;
  write_text(folder / "victim", "precious");
  const auto expect_refused = [&](const char* what) {
    EXPECT_NE(refusal(folder / "").find(".lock: is no plain file"), std::string::npos)
        << what << ": " << refusal(folder / "");
    EXPECT_EQ(text_of(folder / "victim"), "precious") << what;
    fs::remove(folder / ".lock");
  };
  fs::create_symlink(folder / "victim", folder / ".lock");
  expect_refused("a link");
  fs::create_hard_link(folder / "victim", folder / ".lock");
  expect_refused("a second name");
  ASSERT_EQ(::mkfifo((folder / ".lock").c_str(), 0600), 0);
  expect_refused("a pipe");
  EXPECT_EQ(refusal(folder / ""), "");
}

}  // namespace
}  // namespace tripoint
