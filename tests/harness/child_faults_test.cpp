// SPDX-License-Identifier: BSD-3-Clause
// What can happen to a child process, as its parent sees it: each becomes a row with its reason, and none a
// pass (docs/promises.md, "Faults of a child").
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include "assembly/plan.hpp"
#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "tables/toml_node.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/process.hpp"
#include "validation/run/third_party_reader.hpp"

namespace {

/// Lets the n-th call of its kind fail, counted from 1, or all from it on, and all others through.
struct FailingCall {
  std::atomic<int> calls{0}, failing{0}, error{0};
  std::atomic<bool> for_ever{false};
  bool fails() {
    const int call = ++calls;
    return failing > 0 && (call == failing || (for_ever && call > failing));
  }
  void plan(int which, int why, bool later_ones_too = false) {
    calls = 0;
    failing = which;
    error = why;
    for_ever = later_ones_too;
  }
};
FailingCall spawns, forks, pipes, waits, polls;
std::atomic<bool> copies_hang{false};  ///< of this process, from their first moment on

template <class F>
F* next(const char* name) {
  return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// These stand before the C library's own in this program.
extern "C" {
int posix_spawn(pid_t* pid, const char* path, const posix_spawn_file_actions_t* actions,
                const posix_spawnattr_t* attributes, char* const* argv, char* const* environment) {
  if (spawns.fails()) return spawns.error;
  return next<decltype(posix_spawn)>("posix_spawn")(pid, path, actions, attributes, argv, environment);
}
pid_t fork() noexcept {
  if (forks.fails()) {
    errno = forks.error;
    return -1;
  }
  const pid_t child = next<pid_t()>("fork")();
  while (child == 0 && copies_hang) ::pause();
  return child;
}
int pipe2(int* ends, int flags) noexcept {
  if (pipes.fails()) {
    errno = pipes.error;
    return -1;
  }
  return next<int(int*, int)>("pipe2")(ends, flags);
}
pid_t wait4(pid_t pid, int* status, int options, rusage* use) noexcept {
  if (waits.fails()) {
    errno = waits.error;
    return -1;
  }
  return next<pid_t(pid_t, int*, int, rusage*)>("wait4")(pid, status, options, use);
}
int poll(pollfd* all, nfds_t count, int limit) {
  if (polls.fails()) {
    errno = polls.error;
    return -1;
  }
  return next<int(pollfd*, nfds_t, int)>("poll")(all, count, limit);
}
int __poll_chk(pollfd* all, nfds_t count, int limit, size_t) {
  return poll(all, count, limit);
}  // of a build with _FORTIFY_SOURCE
}

namespace tripoint {
namespace {

constexpr const char* required = "[engines.fake]\nrequired = true\n";

/// What the fake engine does, and what its row must say.
struct ChildFault {
  const char* what;
  Status status;
  const char* words;         ///< of the reason
  double wall_limit = 60.0;  ///< [s]
  int code = exit_missing;   ///< of the suite
};
void PrintTo(const ChildFault& fault, std::ostream* out) { *out << fault.what; }

class ChildFaults : public ::testing::TestWithParam<ChildFault> {};

TEST_P(ChildFaults, AreARowThatSaysWhyAndNeverAPass) {
  const TestFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const auto c = fly(folder, GetParam().what, required, GetParam().wall_limit);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(c.exit_code, GetParam().code);
  ASSERT_EQ(c.engines.size(), 1u);
  EXPECT_EQ(c.engines[0].status, GetParam().status);
  EXPECT_NE(c.engines[0].reason.find(GetParam().words), std::string::npos) << c.engines[0].reason;
}

INSTANTIATE_TEST_SUITE_P(
    Ends, ChildFaults,
    ::testing::Values(
        ChildFault{"dies at info", Status::missing, "--info was killed by signal 9"},
        ChildFault{"dies at check", Status::error, "--check was killed by signal 9"},
        ChildFault{"dies at once", Status::killed, "was killed by signal 9"},
        ChildFault{"leaves half a result", Status::error, "result.json"},
        ChildFault{"dies after its result", Status::error, "says ok but was killed by signal 9"},
        ChildFault{"stops itself", Status::timeout, "was stopped after 1 s", 1.0},
        ChildFault{"hides among its parents and hangs", Status::timeout, "was stopped after 1 s", 1.0}));

INSTANTIATE_TEST_SUITE_P(Lies, ChildFaults,
                         ::testing::Values(ChildFault{"says OK", Status::error, "OK"},
                                           ChildFault{"speaks contract 2", Status::error,
                                                      "is not of contract 1"},
                                           ChildFault{"ends at no time", Status::error, "result.json"},
                                           ChildFault{"says that it diverged", Status::diverged,
                                                      "it gives no place", 60.0, exit_diverged},
                                           ChildFault{"floods its answer", Status::refused,
                                                      "--check did not print {can, reason}"}));

INSTANTIATE_TEST_SUITE_P(
    Files, ChildFaults,
    ::testing::Values(ChildFault{"leaves half a line", Status::error, "cells, the header has"},
                      ChildFault{"leaves half of an H5MD file", Status::error, "trajectory.h5"},
                      ChildFault{"leaves a folder as result", Status::error, "no regular file"},
                      ChildFault{"leaves a result alone", Status::error, "trajectory.csv: cannot be read"},
                      ChildFault{"leaves a frame out", Status::error, "no frame at t = 0.25"},
                      ChildFault{"one value is not a number", Status::error, "not finite"},
                      ChildFault{"one value is infinite", Status::error, "not finite"},
                      ChildFault{"a time is not a number", Status::error, "the time is not finite"},
                      ChildFault{"names a body that is not there", Status::error, "is not one of"},
                      ChildFault{"names a body below the first", Status::error, "is not one of"},
                      ChildFault{"shows no frame", Status::error, "has no frame"},
                      ChildFault{"names half a body", Status::error, "is not one of"},
                      ChildFault{"numbers its particles past the last", Status::error, "is not one of"}));

/// What is no fault of the engine's result does not cost it its pass.
TEST(HarmlessChildEvents, LeaveAGoodResultGood) {
  for (const char* what : {"closes its streams", "leaves files of other years"}) {
    const TestFolder folder;
    const auto c = fly(folder, what, required);
    EXPECT_EQ(c.exit_code, exit_pass)
        << what << ": " << c.engines.at(0).status << " " << c.engines.at(0).reason;
  }
}

TEST(StaleOutput, ATrajectoryOfAnEarlierRunIsNotJudged) {
  const TestFolder folder;
  ASSERT_EQ(fly(folder, "nothing").exit_code, exit_pass);
  ASSERT_TRUE(std::filesystem::exists(folder / "out/runs/test/flight/fake/base/trajectory.csv"));
  const auto c = fly(folder, "leaves a result alone", required);
  EXPECT_EQ(c.engines.at(0).status, Status::error);
  EXPECT_EQ(c.exit_code, exit_missing);
}

/// Which start of a child fails, and what the row must say then.
struct Moment {
  int start;
  Status status;
};
// --info, --check, --run
constexpr Moment moments[] = {{1, Status::missing}, {2, Status::error}, {3, Status::error}};

TEST(Starts, AChildThatCannotBeStartedIsARowWithTheSystemsWords) {
  for (const int error : {EAGAIN, ENOMEM, ENOEXEC})
    for (const auto& [start, status] : moments) {
      const TestFolder folder;
      spawns.plan(start, error);
      const auto c = fly(folder, "nothing", required);
      spawns.plan(0, 0);
      EXPECT_EQ(c.exit_code, exit_missing) << start;
      EXPECT_EQ(c.engines.at(0).status, status) << start;
      EXPECT_NE(c.engines.at(0).reason.find(std::string("could not be started: ") + std::strerror(error)),
                std::string::npos)
          << c.engines.at(0).reason;
    }
}

TEST(Starts, AChildWithoutAPipeIsNotStarted) {
  for (int which = 1; which <= 6; ++which) {  // two pipes a child
    const TestFolder folder;
    pipes.plan(which, EMFILE);
    const auto c = fly(folder, "nothing", required);
    pipes.plan(0, 0);
    EXPECT_EQ(c.exit_code, exit_missing) << which;
    EXPECT_EQ(c.engines.at(0).status, moments[(which - 1) / 2].status) << which;
    EXPECT_NE(c.engines.at(0).reason.find(std::strerror(EMFILE)), std::string::npos)
        << c.engines.at(0).reason;
  }
}

TEST(Starts, AForeignFileIsNotReadWhereNoCopyCanTryIt) {
  int done = 0;
  forks.plan(1, EAGAIN);
  EXPECT_THROW(try_of_third_party([&] { ++done; }, {"a file"}, 5.0), EngineError);
  forks.plan(0, 0);
  EXPECT_EQ(done, 0);
}

TEST(Starts, ACaseFileIsNotReadWhereNoCopyCanTryIt) {
  std::string told;
  forks.plan(1, EAGAIN);
  try {
    static_cast<void>(parse_toml("a = 1\n", "case.toml"));
  } catch (const std::system_error& e) {
    told = e.what();
  }
  forks.plan(0, 0);
  EXPECT_NE(told.find("case.toml was not read: there is no process to spare"), std::string::npos) << told;
  EXPECT_NE(told.find(std::strerror(EAGAIN)), std::string::npos) << told;
}

TEST(Starts, CaseFilesThatOneCopyHasTriedNeedNoneOfTheirOwn) {
  const TestFolder folder;
  const auto one = folder / "one.toml", other = folder / "other.toml", wrong = folder / "wrong.toml";
  write_text(one, "one = 1\n");
  write_text(wrong, "wrong = 1 2\n");
  write_text(other, "other = 2\n");
  try_toml_files({one, folder / "absent.toml", wrong, other});
  forks.plan(1, EAGAIN);
  EXPECT_NE(read_toml(one).find("one"), nullptr);
  EXPECT_NE(read_toml(other).find("other"), nullptr);
  std::string told;
  try {
    static_cast<void>(read_toml(wrong));
  } catch (const InputError& e) {
    told = e.what();
  }
  forks.plan(0, 0);
  EXPECT_NE(told.find("no valid TOML"), std::string::npos) << told;
}

TEST(Starts, CaseFilesWhoseCommonCopyHangsHaveEachItsOwn) {
  const TestFolder folder;
  const auto file = folder / "case.toml";
  write_text(file, "hung = 1\n");
  copies_hang = true;
  try_toml_files({file}, 0.2);
  copies_hang = false;
  forks.plan(1, EAGAIN);
  EXPECT_THROW(static_cast<void>(read_toml(file)), std::system_error);
  forks.plan(0, 0);
  EXPECT_NE(read_toml(file).find("hung"), nullptr);
}

TEST(Starts, ACaseFileWhoseCopyHangsIsRefusedAtTheLimit) {
  std::string told;
  copies_hang = true;
  try {
    static_cast<void>(parse_toml("b = 1\n", "case.toml", 0.2));
  } catch (const InputError& e) {
    told = e.what();
  }
  copies_hang = false;
  EXPECT_NE(told.find("case.toml: could not be read within 0.2 s"), std::string::npos) << told;
}

TEST(Waits, AnEndThatNobodyTellsIsADeathAndIsKnownAtOnce) {
  const TestFolder folder;
  waits.plan(1, ECHILD, true);
  const auto c = fly(folder, "nothing", required);
  waits.plan(0, 0);
  EXPECT_EQ(c.exit_code, exit_missing);
  EXPECT_EQ(c.engines.at(0).status, Status::missing);
  // Not a timeout
  EXPECT_NE(c.engines.at(0).reason.find("was killed by signal 9"), std::string::npos)
      << c.engines.at(0).reason;
}

TEST(Waits, ASignalThatComesMeanwhileChangesNothing) {
  for (int which = 1; which <= 8; ++which) {
    ProcessSpec spec;
    spec.argv = {"/bin/sh", "-c", "sleep 0.02; exit 3"};
    spec.wall_limit = 5.0;
    waits.plan(which, EINTR);
    polls.plan(which, EINTR);
    const auto end = run_process(spec);
    waits.plan(0, 0);
    polls.plan(0, 0);
    EXPECT_EQ(describe(end), "exited with code 3") << which;
  }
}

TEST(Waits, WhatAChildSaysComesWholeWhereNothingCanBeWaitedFor) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", "head -c 300000 /dev/zero | tr '\\0' x; head -c 300000 /dev/zero >&2"};
  spec.wall_limit = 20.0;
  polls.plan(1, ENOMEM, true);
  const auto end = run_process(spec);
  polls.plan(0, 0);
  EXPECT_EQ(describe(end), "exited with code 0");
  EXPECT_EQ(end.output.size(), 300000u);
}

/// A shell that starts us with `trap '' CHLD` hands that down: the system then throws the ends of children
/// away.
class EndsThrownAway : public ::testing::Test {
 protected:
  EndsThrownAway() { before_ = ::signal(SIGCHLD, SIG_IGN); }
  ~EndsThrownAway() override { ::signal(SIGCHLD, before_); }

 private:
  sighandler_t before_ = nullptr;
};

TEST_F(EndsThrownAway, AreKeptByWhoStartsAnEngine) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", "exit 3"};
  spec.wall_limit = 5.0;
  const auto end = run_process(spec);
  EXPECT_EQ(describe(end), "exited with code 3");
}

TEST_F(EndsThrownAway, AreKeptByWhoTriesAFile) {
  EXPECT_THROW(try_of_third_party([] { ::raise(SIGSEGV); }, {"a file"}, 5.0), EngineError);
}

TEST(ForkStorm, EndsWithItsRun) {
  const TestFolder folder;
  // Each in a session of its own; half of them become children of ours, and their parents are gone.
  ProcessSpec spec;
  spec.argv = {"/usr/bin/python3", "-c",
               "import os, time\n"
               "for n in range(200):\n"
               "  if os.fork() == 0:\n"
               "    os.setsid()\n"
               "    if os.fork() and n % 2: os._exit(0)\n"
               "    time.sleep(300)\n"};
  const auto end = run_process(spec);
  EXPECT_EQ(describe(end), "exited with code 0");
  spec.argv = {"/bin/sh", "-c",
               "cat /proc/[0-9]*/cmdline 2>/dev/null | tr '\\0' ' ' | grep -c 'os.fork() and n % [2]'"};
  EXPECT_EQ(run_process(spec).output, "0\n");
}

TEST(ForkStorm, OneThatIsAlwaysAnotherProcessEndsWithItsRun) {
  const TestFolder folder;
  const std::string beats = folder / "beats";  // a byte for each process
  write_text(beats, "");
  ProcessSpec spec;
  spec.argv = {"/usr/bin/python3", "-c",
               "import os, sys, time\n"
               "end, beats = time.monotonic() + 60, sys.argv[1]\n"
               "if os.fork():\n"
               "  while os.path.getsize(beats) < 20: time.sleep(0.01)\n"
               "  os._exit(0)\n"
               "while time.monotonic() < end:\n"
               "  os.setsid()\n"
               "  with open(beats, 'a') as file: file.write('x')\n"
               "  if os.fork(): os._exit(0)\n",
               beats};
  EXPECT_EQ(describe(run_process(spec)), "exited with code 0");
  ::usleep(100'000);  // one that was killed may be ending still
  const auto last = std::filesystem::file_size(beats);
  EXPECT_GE(last, 20u);
  ::usleep(300'000);
  EXPECT_EQ(std::filesystem::file_size(beats), last) << "it outlived its run";
}

}  // namespace
}  // namespace tripoint
