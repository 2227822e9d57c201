// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "harness/fakes.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace {

ProcessSpec shell(const std::string& script, double limit = 20.0) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", script};
  spec.wall_limit = limit;
  return spec;
}

TEST(Process, OutputCodeAndLastWordsComeBack) {
  const auto end = run_process(shell("echo out; echo err >&2; exit 3"));
  EXPECT_EQ(end.how, ProcessEnd::How::exited);
  EXPECT_EQ(end.code, 3);
  EXPECT_EQ(end.output, "out\n");
  EXPECT_EQ(end.log_tail, "err\n");
}

TEST(Process, AProgramThatIsNotThereIsNotStarted) {
  ProcessSpec spec;
  spec.argv = {"/no/such/program"};
  EXPECT_EQ(run_process(spec).how, ProcessEnd::How::not_started);
}

TEST(Process, MemoryIsTheChildsAndNotThatOfWhoStartedIt) {
  constexpr std::size_t much = 300u << 20;
  std::vector<char> ours(much, 'x');  // every page is touched
  EXPECT_EQ(ours[much / 2], 'x');
  const auto small = run_process(shell("sleep 0.1"));
  EXPECT_GT(small.peak_bytes, 2e5);
  EXPECT_LT(small.peak_bytes, 5e7);
  ours = {};
  const auto large = run_process(
      shell("exec /usr/bin/python3 -c 'import time; x = bytearray(b\"1\") * 60000000; time.sleep(0.5)'"));
  EXPECT_GT(large.peak_bytes, 6e7);
  EXPECT_LT(large.peak_bytes, 2e8);
}

TEST(Process, TheWholeGroupDiesAtTheLimit) {
  const TestFolder folder;
  const auto file = folder / "pid";
  const auto end = run_process(shell("sleep 300 & echo $! > " + file + "; wait", 0.5));
  EXPECT_EQ(end.how, ProcessEnd::How::timed_out);
  pid_t grandchild = 0;
  std::ifstream(file) >> grandchild;
  ASSERT_GT(grandchild, 0);
  EXPECT_NE(::kill(grandchild, 0), 0) << "the grandchild outlived its group";
}

TEST(Process, ADaemonInASessionOfItsOwnEndsWithItsRun) {
  const TestFolder folder;
  const auto file = folder / "pid";
  const auto end = run_process(shell("setsid sh -c 'setsid sleep 300 & echo $! > " + file + "' ; exit 0"));
  EXPECT_EQ(end.how, ProcessEnd::How::exited);
  pid_t daemon = 0;
  std::ifstream(file) >> daemon;
  ASSERT_GT(daemon, 0);
  std::ifstream left(std::filesystem::path("/proc") / std::to_string(daemon) / "cmdline");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(left), {}), "") << "it outlived its run";
}

TEST(Process, WhatAHarnessInsideARunStartedEndsWithThatRun) {
  const TestFolder folder;
  const auto file = folder / "pid";
  const auto end = run_process(shell("TRIPOINT_RUN=$TRIPOINT_RUN/7.7/0 setsid sleep 300 & echo $! > " +
                                     file));  // marked as such a harness marks its engines
  EXPECT_EQ(end.how, ProcessEnd::How::exited);
  pid_t engine = 0;
  std::ifstream(file) >> engine;
  ASSERT_GT(engine, 0);
  std::ifstream left(std::filesystem::path("/proc") / std::to_string(engine) / "cmdline");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(left), {}), "") << "it outlived the run";
}

TEST(Process, TheGroupsCpuTimeCountsGrandchildrenThatNobodyWaitedFor) {
  const auto end =
      run_process(shell("(i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done; sleep 60) & sleep 1; exit 0"));
  EXPECT_EQ(end.how, ProcessEnd::How::exited);
  EXPECT_GT(end.cpu_s, 0.05);  // the loop of the orphan; the leader itself takes a millisecond
}

TEST(Process, AnOrphanThatHoldsThePipesDoesNotHoldUs) {
  const auto start = std::chrono::steady_clock::now();
  const auto end = run_process(shell("sleep 30 & exit 0"));
  EXPECT_EQ(end.how, ProcessEnd::How::exited);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Process, ProgressLinesAreReported) {
  auto spec = shell(
      "echo progress 0.25 >&2; echo noise >&2; echo progress nan >&2; echo progress -1e999 >&2; echo "
      "progress 7 >&2");
  std::vector<double> seen;
  spec.progress = [&](double done) { seen.push_back(done); };
  (void)run_process(spec);
  EXPECT_EQ(seen, (std::vector<double>{0.25, 1.0}));
}

TEST(Process, StatusLinesAreReportedWithoutTheirWord) {
  auto spec = shell(
      "echo 'status {\"time\": 1}' >&2; echo statuses >&2; { printf 'status '; head -c 5000 /dev/zero | tr "
      "'\\0' x; echo; echo "
      "status 2; } >&2");
  std::vector<std::string> seen;
  spec.status = [&](const std::string& status) { seen.push_back(status); };
  (void)run_process(spec);
  EXPECT_EQ(seen, (std::vector<std::string>{"{\"time\": 1}", std::string(400, 'x'), "2"}));
}

TEST(Process, NoOpenFileOfOursIsInherited) {
  const TestFolder folder;
  std::ofstream open(folder / "open");
  // 0, 1, 2 and the folder that ls reads
  EXPECT_EQ(run_process(shell("ls /proc/self/fd | wc -l")).output, "4\n");
}

TEST(Process, AFloodOnStdoutIsCut) {
  const auto end = run_process(shell("head -c 20000000 /dev/zero | tr '\\0' x"));
  EXPECT_EQ(end.output.size(), 4u << 20);
  EXPECT_EQ(end.code, 0);
}

/// Of a sandbox that holds a shell and what it starts.
ProcessEnd bounded(const SandboxSums& most, const std::string& folder, const std::string& deeds) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", deeds + "; sleep 30"};
  spec.folder = folder;
  spec.in_sandbox = true;
  spec.most = most;
  spec.wall_limit = 20.0;
  return run_process(spec);
}

/// Of an engine outside of any sandbox, whose folder is watched.
ProcessEnd watched(const std::string& folder, const std::string& deeds, std::size_t files = 50) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", deeds + "; sleep 30"};
  spec.folder = folder;
  spec.most.files = files;
  spec.wall_limit = 25.0;
  return run_process(spec);
}

TEST(Process, EndlessOutputEndsIt) {
  for (const char* stream : {"1", "2"}) {
    const auto end = run_process(shell(std::string("exec tr '\\0' x </dev/zero >&") + stream));
    EXPECT_EQ(describe(end), "was killed because it wrote more than 1024 MiB to stdout and stderr");
  }
}

TEST(Process, OneThatIsStoppedAndNotLetGoOnIsEnded) {
  for (const char* deeds : {"kill -STOP $$", "sh -c 'kill -STOP $$'", "sleep 60 & kill -STOP $!; wait"}) {
    const auto end = run_process(shell(deeds));
    EXPECT_EQ(describe(end), "was killed because it was stopped (SIGSTOP) and not let go on for 10 s")
        << deeds;
    EXPECT_LT(end.wall_s, 20.0);
  }
}

TEST(Process, OneThatIsStoppedForAMomentGoesOn) {
  const auto end = run_process(shell("(sleep 2; kill -CONT $$) & kill -STOP $$; exit 3"));
  EXPECT_EQ(end.code, 3) << describe(end);
}

TEST(Process, FloodsOfFoldersEndItAndGoAwayAndWhatWasThereBeforeStays) {
  const TestFolder folder;
  write_text(folder / "job.json", "{}");
  std::filesystem::create_directories(folder / "kept/inner");
  std::vector<std::pair<const char*, const char*>> floods{
      {"for n in $(seq 100); do mkdir d$n; done", "more than 53 files"},
      {"for n in $(seq 100); do ln -s x l$n; done", "more than 53 files"},
      {"for n in $(seq 3000); do mkdir d && cd d || exit; done", "folders more than 64 deep"}};
  if (::geteuid() != 0)  // root looks into any folder
    floods.push_back({"mkdir -p a/b/c; chmod 0 a/b", "a folder that is closed to us"});
  for (const auto& [deeds, words] : floods) {
    const auto end = watched(folder / ".", deeds);
    EXPECT_EQ(describe(end), std::string("was killed because its folder has ") + words);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "."), {}), 2) << deeds;
    EXPECT_TRUE(std::filesystem::exists(folder / "kept/inner"));
  }
}

TEST(Process, FilesThatPassTheirSumGoWithTheRunAndWhatWasThereBeforeStays) {
  const TestFolder folder;
  write_text(folder / "job.json", "{}");
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", "/usr/bin/fallocate -l 8M big"};  // done before the next look
  spec.folder = folder / ".";
  spec.in_sandbox = true;
  spec.most = {0.0, 0, 2e6};
  spec.wall_limit = 20.0;
  const auto end = run_process(spec);
  EXPECT_NE(describe(end).find("MB of files, and 2 MB are allowed"), std::string::npos) << describe(end);
  EXPECT_FALSE(std::filesystem::exists(folder / "big"));
  EXPECT_TRUE(std::filesystem::exists(folder / "job.json"));
}

TEST(Process, WhatPassesASumOfTheSandboxIsKilledAndNamed) {
  const TestFolder folder;
  constexpr double mega = 1e6;
  const auto expect = [&](const SandboxSums& most, const std::string& deeds, const std::string& words) {
    const auto end = bounded(most, folder / ".", deeds);
    EXPECT_EQ(end.how, ProcessEnd::How::signalled);
    EXPECT_NE(describe(end).find(words), std::string::npos) << describe(end);
  };
  expect({0.0, 4, 0.0}, "for n in 1 2 3 4 5 6 7 8; do sleep 20 & done", "more than 4 processes");
  expect({50.0 * mega, 0, 0.0}, "/usr/bin/python3 -c 'import time; x = bytearray(200 << 20); time.sleep(20)'",
         "MB of memory");
  expect({0.0, 0, 2.0 * mega}, "/bin/dd if=/dev/zero of=big bs=1M count=8 2>/dev/null", "MB of files");
  expect({0.0, 0, 2.0 * mega}, "exec 3>gone; rm gone; /bin/dd if=/dev/zero bs=1M count=8 >&3 2>/dev/null",
         "MB of files");
}

}  // namespace
}  // namespace tripoint
