// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/confined_copy.hpp"

namespace tripoint {
namespace {

using How = CopyEnd::How;

constexpr const char* folder = "/tmp";

CopyBounds bounds_of(const char* sees) {
  CopyBounds bounds{"a file", 20.0};
  bounds.folder = sees;
  return bounds;
}

CopyEnd in_copy(const std::function<std::string()>& read, const char* sees = folder) {
  return read_in_confined_copy(read, bounds_of(sees));
}

/// A file with some words, that goes at the end.
class FileOfText {
 public:
  FileOfText() {
    std::string path = "/tmp/confined-XXXXXX";
    const int fd = ::mkstemp(path.data());
    if (fd < 0 || ::write(fd, "words", 5) != 5) throw std::runtime_error("no file");
    ::close(fd);
    path_ = path;
  }
  ~FileOfText() { ::unlink(path_.c_str()); }
  FileOfText(const FileOfText&) = delete;
  FileOfText& operator=(const FileOfText&) = delete;
  [[nodiscard]] const char* path() const { return path_.c_str(); }

 private:
  std::string path_;
};

TEST(ConfinedCopy, HandsBackWhatItRead) {
  const FileOfText file;
  const auto end = in_copy([&] {
    std::ifstream in(file.path());
    std::string words;
    in >> words;
    return words + std::string(1, '\0') + std::string(3'000'000, 'x');
  });
  EXPECT_EQ(end.how, How::read);
  EXPECT_EQ(end.bytes, "words" + std::string(1, '\0') + std::string(3'000'000, 'x'));
}

TEST(ConfinedCopy, ChangesNothingOfOurs) {
  int done = 0;
  static_cast<void>(in_copy([&] {
    ++done;
    return std::string();
  }));
  EXPECT_EQ(done, 0);
}

TEST(ConfinedCopy, ARefusalKeepsItsPlaceAndWords) {
  const auto end = in_copy([]() -> std::string { throw InputError({"a:b 1 2.obj", 7, 3}, "no corner: 5"); });
  EXPECT_EQ(end.how, How::refused);
  try {
    rethrow(end);
    FAIL() << "nothing was thrown";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "a:b 1 2.obj:7:3: no corner: 5");
    EXPECT_EQ(e.place().file, "a:b 1 2.obj");
    EXPECT_EQ(e.place().line, 7);
    EXPECT_EQ(e.place().column, 3);
  }
  const auto other = in_copy([]() -> std::string { throw std::runtime_error("torn"); });
  EXPECT_EQ(other.how, How::refused);
  EXPECT_EQ(other.bytes, "torn");
}

TEST(ConfinedCopy, ADeathIsTold) {
  const CopyBounds bounds = bounds_of("");
  const auto end = read_in_confined_copy([]() -> std::string { ::abort(); }, bounds);
  EXPECT_EQ(end.how, How::killed);
  EXPECT_EQ(failure_of(end, bounds), "a file kills the library that reads it (signal 6, Aborted)");
}

/// Whether the system can confine a copy: Linux before 5.13 cannot, and valgrind does not.
bool is_confined_here() {
  CopyBounds bounds = bounds_of(folder);
  bounds.must_be_confined = true;
  return read_in_confined_copy([] { return std::string(); }, bounds).how == How::read;
}

/// What code that a file brings along would try; each gives whether it worked.
using Deed = std::pair<const char*, std::function<bool()>>;

std::vector<Deed> deeds(const char* file, pid_t parent) {
  return {{"writes a file", [=] { return ::open(file, O_WRONLY) >= 0; }},
          {"empties a file", [=] { return ::open(file, O_RDONLY | O_TRUNC) >= 0; }},
          {"makes a file",
           [=] { return ::open((std::string(file) + ".new").c_str(), O_RDONLY | O_CREAT, 0600) >= 0; }},
          {"makes a file without a name", [] { return ::open("/tmp", O_RDWR | O_TMPFILE, 0600) >= 0; }},
          {"removes a file", [=] { return ::unlink(file) == 0; }},
          {"renames a file", [=] { return ::rename(file, (std::string(file) + ".other").c_str()) == 0; }},
          {"makes a file runnable", [=] { return ::chmod(file, 0755) == 0; }},
          {"opens a socket", [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; }},
          {"starts a process", [] { return ::fork() >= 0; }},
          {"starts a program", [] { return ::execl("/bin/true", "true", nullptr) == 0; }},
          {"signals its parent", [=] { return ::kill(parent, 0) == 0; }},
          {"has the system signal its parent",
           [=] { return ::fcntl(::open(folder, O_RDONLY), F_SETOWN, parent) == 0; }},
          {"chooses a signal", [] { return ::fcntl(::open(folder, O_RDONLY), F_SETSIG, SIGKILL) == 0; }},
          {"locks others out", [=] { return ::flock(::open(file, O_RDONLY), LOCK_EX | LOCK_NB) == 0; }},
          {"runs what it wrote",
           [] {
             return ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                           0) != MAP_FAILED;
           }},
          {"raises its limits", [] {
             const rlimit much{RLIM_INFINITY, RLIM_INFINITY};
             return ::setrlimit(RLIMIT_AS, &much) == 0;
           }}};
}

TEST(ConfinedCopy, CanDoNothingButRead) {
  if (!is_confined_here()) GTEST_SKIP() << "this system cannot confine a reader";
  const FileOfText file;
  for (const auto& [name, deed] : deeds(file.path(), ::getpid())) {
    const auto end = in_copy([&] {
      return std::string(deed() ? "worked" : errno == EPERM ? "refused" : "failed otherwise");
    });
    EXPECT_EQ(end.how, How::read) << name;
    EXPECT_EQ(end.bytes, "refused") << name;
  }
}

std::string opened(const std::string& path) {
  return ::open(path.c_str(), O_RDONLY) >= 0 ? "opened"
         : errno == EPERM || errno == EACCES ? "refused"
                                             : "failed otherwise";
}

TEST(ConfinedCopy, SeesOneFolderAtMost) {
  if (!is_confined_here()) GTEST_SKIP() << "this system cannot confine a reader";
  const FileOfText file;
  const std::string memory = "/proc/" + std::to_string(::getpid()) + "/mem";
  for (const std::string& path : {std::string("/etc/passwd"), memory}) {
    EXPECT_EQ(in_copy([&] { return opened(path); }).bytes, "refused") << path;
    EXPECT_EQ(in_copy([&] { return opened(path); }, "").bytes, "refused") << path;
  }
  EXPECT_EQ(in_copy([&] { return opened(file.path()); }).bytes, "opened");
  EXPECT_EQ(in_copy([&] { return opened(file.path()); }, "").bytes, "refused");
}

TEST(ConfinedCopy, HandsBackNoMoreThanItMay) {
  CopyBounds bounds = bounds_of("");
  bounds.most_bytes = 1000;
  EXPECT_EQ(read_in_confined_copy([] { return std::string(1000, 'x'); }, bounds).bytes.size(), 1000u);
  EXPECT_EQ(read_in_confined_copy([] { return std::string(1'000'000, 'x'); }, bounds).how, How::no_memory);
  const auto far = [] {  // a file with a hole, which costs nothing
    if (::lseek(3, off_t{1} << 40, SEEK_SET) < 0 || ::write(3, "x", 1) != 1) ::lseek(3, 0, SEEK_SET);
    return std::string("x");
  };
  EXPECT_EQ(read_in_confined_copy(far, bounds).bytes, "x");
}

TEST(ConfinedCopy, AnEndThatIsNotItsOwnIsADeath) {
  const CopyBounds bounds = bounds_of("");
  const auto end = read_in_confined_copy([]() -> std::string { ::_exit(1); }, bounds);
  EXPECT_EQ(end.how, How::killed);
  EXPECT_EQ(failure_of(end, bounds), "a file ends the program that reads it");
}

TEST(ConfinedCopy, EndsWithItsParent) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // who loses a parent becomes a child of ours
  const pid_t parent = ::fork();
  if (parent == 0) {
    static_cast<void>(in_copy([]() -> std::string {
      for (;;) ::pause();
    }));
    ::_exit(0);
  }
  ::usleep(300'000);
  ::kill(parent, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(parent, &status, 0), parent);
  ASSERT_GT(::waitpid(-1, &status, 0), 0) << "there was no copy";
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << status;
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST(ConfinedCopy, HasNoOpenFileOfOurs) {
  const FileOfText file;
  const int ours = ::open(file.path(), O_WRONLY | O_APPEND), far = ::fcntl(ours, F_DUPFD, 500);
  ASSERT_GE(far, 500);
  const auto end = in_copy([far] {
    return std::string(::write(far, "x", 1) == 1 || ::fcntl(far, F_GETFD) >= 0 ? "ours" : "none");
  });
  EXPECT_EQ(end.bytes, "none");
  ::close(ours);
  ::close(far);
  std::ifstream in(file.path());
  std::string words;
  in >> words;
  EXPECT_EQ(words, "words");
}

TEST(ConfinedCopy, ItsWordsAreNotBelievedToBeARefusal) {
  CopyEnd end;
  end.how = How::refused;
  end.bytes = "anything";
  EXPECT_THROW(rethrow(end), InputError);
}

}  // namespace
}  // namespace tripoint
