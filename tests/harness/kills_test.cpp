// SPDX-License-Identifier: BSD-3-Clause
// Frames that our solver announces survive its death.
#include <gtest/gtest.h>

#include <sstream>

#include "files/job.hpp"
#include "files/trajectory.hpp"
#include "harness/fakes.hpp"
#include "sampling/sample.hpp"
#include "validation/run/run_one.hpp"

namespace tripoint {
namespace {

/// A small fast scene with very many frames: nearly all of its time is spent in writing.
Case many_frames(const TestFolder& folder) {
  auto text = flight_case();
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("end_time = 0.5", "end_time = 50.0");
  replace("output_interval = 0.05", "output_interval = 0.01");
  write_text(folder / "cases/test/flight.toml", text);
  return read_case(folder / "cases/test/flight.toml").value;
}

TEST(Kills, EveryFrameAnnouncedAsWrittenIsReadableAfterTwentyKills) {
  const auto engine = ask_engine(program_folder() + "/../libexec/tripoint/engine-tripoint");
  ASSERT_TRUE(engine.available) << engine.reason;
  const TestFolder folder;
  const auto value = many_frames(folder);
  const auto plan = plan_runs(value, {engine}, {}).front();
  const auto scene = scene_of(value, plan.runs.front());
  const auto initial = sample(scene);
  auto job = make_job(value, plan, plan.runs.front(), scene, initial);
  job.particles = folder / "particles.h5";
  write_particles(job.particles, initial);
  int killed = 0;
  long greatest = 0;
  for (int n = 0; n < 20; ++n) {
    const auto out = folder / ("run" + std::to_string(n));
    std::filesystem::create_directories(out);
    job.output = out;
    write_job(out + "/job.json", job);
    ProcessSpec spec;
    spec.argv = {engine.executable, "--run", out + "/job.json"};
    spec.folder = out;
    spec.log = out + "/log.txt";
    spec.wall_limit = 0.06 + 0.013 * n;  // SIGKILL to the group, at twenty different moments
    const auto end = run_process(spec);
    killed += end.how == ProcessEnd::How::timed_out;
    long announced = 0;  // the last whole line `frame N t ...` of stderr, counted from 0
    std::istringstream log(end.log_tail.substr(0, end.log_tail.rfind('\n') + 1));
    for (std::string word; log >> word;)
      if (word == "frame" && log >> announced) ++announced;
    if (announced == 0) continue;
    greatest = std::max(greatest, announced);
    const auto trajectory = read_trajectory(out + "/trajectory.h5");
    ASSERT_GE(trajectory.frames.size(), static_cast<std::size_t>(announced)) << "kill " << n;
    for (long k = 0; k < announced; ++k) {
      const auto& frame = trajectory.frames[static_cast<std::size_t>(k)];
      ASSERT_NEAR(frame.time, job.times[static_cast<std::size_t>(k)], 1e-9 * job.times.back());
      for (const auto& r : frame.position) ASSERT_TRUE(finite(r));
    }
  }
  EXPECT_GE(killed, 10) << "the scene is too short to be killed while it writes";
  EXPECT_GT(greatest, 10) << "the engine never announced frames";
}

}  // namespace
}  // namespace tripoint
