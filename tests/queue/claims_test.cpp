// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "queue/folder.hpp"
#include "validation/queue/published.hpp"
#include "validation/queue/standing.hpp"
#include "validation/queue/status.hpp"
#include "validation/queue/worker.hpp"

namespace tripoint {
namespace {
namespace fs = std::filesystem;
using test::queue_of;
using test::SuiteFolder;

TEST(Claims, AreWonByOneWorkerEach) {
  const auto queue = queue_of(400);
  const SuiteFolder folder(queue);
  std::atomic<int> won{0};
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n)
    threads.emplace_back([&, n] {
      const Worker worker(folder.dir(), n);
      for (const auto& job : queue.jobs)
        if (worker.claim(job.id)) {
          ++won;
          worker.finish(job.id, "{}", false);
        }
    });
  for (auto& t : threads) t.join();
  EXPECT_EQ(won, 400);
  const auto standing = look(folder.dir(), queue);
  EXPECT_EQ(standing.count(Stand::done), 400U);
  EXPECT_TRUE(standing.workers.empty());  // they took their signs with them
}

TEST(Claims, OfAWorkerThatWasKilledAreLostAndOneOtherTakesThemOver) {
  const auto queue = queue_of(3);
  const SuiteFolder folder(queue);
  const pid_t child = ::fork();
  if (child == 0) {
    auto worker = std::make_unique<Worker>(folder.dir(), 0);
    static_cast<void>(worker->claim(queue.jobs[1].id));
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  const auto standing = look(folder.dir(), queue);
  EXPECT_EQ(standing.jobs[0].stand, Stand::waiting);
  ASSERT_EQ(standing.jobs[1].stand, Stand::lost);
  const auto dead = standing.jobs[1].worker;
  EXPECT_NE(dead.find(std::to_string(child)), std::string::npos);
  const Worker one(folder.dir(), 1), two(folder.dir(), 2);
  EXPECT_TRUE(one.take_over(queue.jobs[1].id, dead));
  EXPECT_FALSE(two.take_over(queue.jobs[1].id, dead));
  const auto after = look(folder.dir(), queue);
  EXPECT_EQ(after.jobs[1].stand, Stand::running);
  EXPECT_EQ(after.jobs[1].worker, one.name());
  EXPECT_EQ(after.losses.at(queue.jobs[1].id), 1);
}

TEST(Claims, GoBackWhenTheyAreReleased) {
  const auto queue = queue_of(1);
  const SuiteFolder folder(queue);
  const Worker worker(folder.dir(), 0);
  ASSERT_TRUE(worker.claim(queue.jobs[0].id));
  EXPECT_FALSE(worker.claim(queue.jobs[0].id));
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::running);
  worker.release(queue.jobs[0].id);
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::waiting);
}

/// A worker of another machine: nobody here can ask for its process, only for its sign.
TEST(Claims, OfAnotherMachineAreLostAfterAMinuteWithoutASign) {
  const auto queue = queue_of(1);
  const SuiteFolder folder(queue);
  std::ofstream(folder / "workers/far.1.1.0.json")
      << R"({"host": "far", "machine": "another", "pid": 1, "started": "1"})";
  fs::rename(folder / ("todo/" + queue.jobs[0].id), folder / ("running/" + queue.jobs[0].id + ".far.1.1.0"));
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::running);
  const auto age_by = [&](double seconds) {
    const double then = file_clock(folder.dir()) - seconds;
    const timespec times[2] = {{static_cast<time_t>(then), 0}, {static_cast<time_t>(then), 0}};
    ::utimensat(AT_FDCWD, (folder / "workers/far.1.1.0.json").c_str(), times, 0);
  };
  age_by(0.8 * lost_after);
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::running);
  age_by(1.2 * lost_after);
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::lost);
  fs::remove(folder / "workers/far.1.1.0.json");
  EXPECT_EQ(look(folder.dir(), queue).jobs[0].stand, Stand::lost);
}

TEST(Claims, AJobThatIsNowhereIsLost) {
  const auto queue = queue_of(2);
  const SuiteFolder folder(queue);
  fs::remove(folder / ("todo/" + queue.jobs[0].id));
  const auto standing = look(folder.dir(), queue);
  EXPECT_EQ(standing.jobs[0].stand, Stand::lost);
  EXPECT_TRUE(standing.jobs[0].worker.empty());
}

RunRow row_of(double value, double seconds) {
  RunRow row;
  row.metrics["position"] = {value, {}, "", {}, {}};
  row.cost.cpu_s = seconds;
  row.state_hash = "abc";
  return row;
}

TEST(Publishing, PutsTheFirstResultAndRefusesTheSecond) {
  const auto queue = queue_of(1);
  const SuiteFolder folder(queue);
  const auto& job = queue.jobs[0];
  for (const char* name : {"a", "b"}) {
    fs::create_directories(folder / name);
    std::ofstream(folder / name / "result.json") << name;
  }
  EXPECT_EQ(published_id(folder.dir(), job), "");
  EXPECT_THROW(static_cast<void>(published_run(folder.dir(), job)), InputError);
  EXPECT_TRUE(publish(folder.dir(), job, {row_of(0.1, 1.0), {}}, (folder / "a").string(), "one"));
  EXPECT_FALSE(publish(folder.dir(), job, {row_of(0.2, 1.0), {}}, (folder / "b").string(), "two"));
  EXPECT_EQ(published_id(folder.dir(), job), job.id);
  EXPECT_DOUBLE_EQ(published_run(folder.dir(), job).row.metrics.at("position").value, 0.1);
  EXPECT_TRUE(fs::exists(folder / run_folder(job) / "result.json"));
}

TEST(Publishing, ClearsAwayWhatAnotherJobLeftInItsPlace) {
  const auto queue = queue_of(1);
  const SuiteFolder folder(queue);
  auto older = queue.jobs[0];
  older.id = "00000000000000ff";  // the same place in the report, of a case that has changed since
  fs::create_directories(folder / "a");
  fs::create_directories(folder / "b");
  ASSERT_TRUE(publish(folder.dir(), older, {row_of(0.1, 1.0), {}}, (folder / "a").string(), "one"));
  EXPECT_TRUE(publish(folder.dir(), queue.jobs[0], {row_of(0.2, 1.0), {}}, (folder / "b").string(), "two"));
  EXPECT_DOUBLE_EQ(published_run(folder.dir(), queue.jobs[0]).row.metrics.at("position").value, 0.2);
}

TEST(Publishing, TellsARunThatDiffersFromOneThatOnlyTookLonger) {
  EXPECT_TRUE(same_outcome(row_of(0.1, 1.0), row_of(0.1, 2.0)));
  EXPECT_FALSE(same_outcome(row_of(0.1, 1.0), row_of(std::nextafter(0.1, 1.0), 1.0)));
}

TEST(Status, OfTenThousandJobsTakesLessThanASecond) {
  const auto queue = queue_of(10000);
  const SuiteFolder folder(queue, 7000);
  double best = 1e9;  // of three: the machine may be busy with other work
  for (int n = 0; n < 3; ++n) {
    const auto start = std::chrono::steady_clock::now();
    const auto read = read_queue(folder.dir());
    const auto text = status_json(folder.dir(), read, status_of(folder.dir(), read));
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    EXPECT_NE(text.find("\"done\": 7000"), std::string::npos);
    EXPECT_NE(text.find("\"waiting\": 3000"), std::string::npos);
  }
  fmt::print("status of 10000 jobs: {:.3f} s\n", best);
  EXPECT_LT(best, 1.0);
}

TEST(Status, ForeseesTheTimeThatIsLeftByWhatIsDone) {
  const auto queue = queue_of(100);  // each predicted to take 1 s
  const SuiteFolder folder(queue, 40);
  const auto status = status_of(folder.dir(), queue);
  EXPECT_DOUBLE_EQ(status.rest, 60.0);
  EXPECT_DOUBLE_EQ(status.seconds_left, 180.0);
}

}  // namespace
}  // namespace tripoint
