// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "validation/queue/queue.hpp"

namespace tripoint::test {

inline QueuedJob job(int n, double cost = 1.0) {
  return {fmt::format("{:016x}", n), "test/flight", "fake", "default", fmt::format("run{}", n), cost};
}

inline Queue queue_of(int jobs) {
  Queue queue;
  queue.cases = {{"test/flight", "flight.toml"}};
  for (int n = 0; n < jobs; ++n) queue.jobs.push_back(job(n));
  return queue;
}

/// A folder of a suite that is gone after the test. The first `done` jobs are done, each in 3 s; the others
/// wait.
class SuiteFolder {
 public:
  explicit SuiteFolder(const Queue& queue, int done = 0)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("tripoint-queue-{}-{}", ::getpid(), count_++)) {
    for (const char* name : {state::todo, state::running, state::done, state::failed, state::lost,
                             state::doubled, state::workers})
      std::filesystem::create_directories(path_ / name);
    std::ofstream(path_ / "suite.json") << queue_text(queue);
    for (const auto& j : queue.jobs) {
      if (done-- > 0)
        std::ofstream(path_ / state::done / j.id) << R"({"status": "ok", "wall_s": 3.0})";
      else
        std::ofstream(path_ / state::todo / j.id);
    }
  }
  ~SuiteFolder() { std::filesystem::remove_all(path_); }
  SuiteFolder(const SuiteFolder&) = delete;
  SuiteFolder& operator=(const SuiteFolder&) = delete;
  [[nodiscard]] std::string dir() const { return path_.string(); }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  inline static int count_ = 0;
  std::filesystem::path path_;
};

}  // namespace tripoint::test
