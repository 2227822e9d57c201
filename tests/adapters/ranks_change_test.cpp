// SPDX-License-Identifier: BSD-3-Clause
// What breaks, melts, freezes, flows in or is made to happen over MPI ranks, and checkpoints of them, beside
// one process.
#include <signal.h>

#include <chrono>
#include <thread>
#include <vector>

#include "adapters/changing_scenes.hpp"
#include "adapters/ranks_lab.hpp"
#include "files/result.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

using namespace test::ranks;
using test::Outcome, test::Prepared;

/// @return the run over two ranks
Outcome expect_changes_equal(const Prepared& p, double owners_above = few_bodies) {
  const Outcome one = test::run(one_process, p);
  Outcome two;
  for (const int count : {1, 2, 4}) {
    SCOPED_TRACE(std::to_string(count) + " ranks");
    Outcome many = run_on(count, p, owners_above);
    expect_equal(one, many, count == 1 ? alone : shared);
    EXPECT_EQ(many.result.extra.at("gatherings") > 0.0, count > 1)
        << "several decide of the whole, one holds it";
    if (count == 2) two = std::move(many);
  }
  return two;
}

void expect_mass_and_momenta_kept(const Outcome& out) {
  const Snapshot &start = out.trajectory.frames.front(), &end = out.trajectory.frames.back();
  EXPECT_LT(norm(end.momentum - start.momentum), 1e-11 * norm(start.momentum));
  EXPECT_LT(norm(end.angular_momentum - start.angular_momentum), 1e-11 * norm(start.angular_momentum));
  EXPECT_NEAR(end.total_mass, start.total_mass, 1e-12 * start.total_mass);
}

TEST(Ranks, TearBarsAsOneProcessDoes) {
  NEEDS_RANKS();
  const Outcome two = expect_changes_equal(test::brittle_bar(true, Mode::corrected));
  expect_mass_and_momenta_kept(two);
  EXPECT_GE(two.trajectory.frames.back().counts.at("objects"), 2.0);
}

TEST(Ranks, MeltFreezeMergeAndSplitAsOneProcessDoes) {
  NEEDS_RANKS();
  for (const double owners_above : {few_bodies, 0.0}) {
    SCOPED_TRACE("owners above " + std::to_string(owners_above));
    const Outcome two = expect_changes_equal(test::merging_and_splitting(SolidKind::rigid), owners_above);
    expect_mass_and_momenta_kept(two);
    EXPECT_EQ(two.trajectory.frames.front().counts.at("objects"), 3.0);
    EXPECT_EQ(two.trajectory.frames.back().counts.at("objects"), 3.0) << "two became one, and one two";
    EXPECT_GT(two.trajectory.frames.back().bodies.size(), 3u) << "a row of its own for what was cut off";
  }
}

TEST(Ranks, SoftenAsOneProcessDoes) {
  NEEDS_RANKS();
  expect_equal_on_ranks(test::warm_rubber());
}

TEST(Ranks, LetEventsHappenAndLiquidFlowInAsOneProcessDoes) {
  NEEDS_RANKS();
  const Outcome two = expect_changes_equal(test::eventful());
  EXPECT_GT(two.trajectory.frames.back().total_mass, 1.3 * two.trajectory.frames.front().total_mass);
}

TEST(Ranks, CarryDensityAsOneProcessDoes) {
  NEEDS_RANKS();
  Prepared p = test::eventful();
  p.job.scene.forms[term::pressure] = "adjoint";
  expect_changes_equal(p);
}

/// Wax flows in, and a layer is due at the time of each frame: whoever has lists of it already tells of it
/// all the same.
TEST(Ranks, TellOfALayerThatHasJustFlowedIn) {
  NEEDS_RANKS();
  Scene s = test::eventful().job.scene;
  Material wax = test::wax(5e4);
  wax.name = "oil";
  wax.viscosity = 0.5;
  wax.stiffness = 1.5e4;
  s.materials[1] = wax;
  s.events = {};
  const Prepared p = test::prepare(s, 0.05, 5);
  expect_equal(test::run(one_process, p), run_on(1, p), alone);
}

/// A guard trips on one rank, and all go back to the same state.
TEST(Ranks, GoBackTogetherWhereAGuardTrips) {
  NEEDS_RANKS();
  const Outcome two = expect_changes_equal(test::ringing_bar());
  EXPECT_GE(two.result.extra.at("recoveries"), 2.0);
  EXPECT_NE(two.result.message.find("recovered"), std::string::npos) << two.result.message;
}

/// Goes on from the only checkpoint of another run, on that many ranks; 0: in one process of the engine
/// tripoint.
Outcome go_on(const test::Folder& from, Prepared p, int count) {
  namespace fs = std::filesystem;
  const test::Folder folder;
  for (const auto& entry : fs::directory_iterator(from.at("."))) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("checkpoint")) p.job.resume = name;
    if (name.starts_with("checkpoint") || name == "trajectory.h5") fs::copy(entry.path(), folder.at(name));
  }
  p.job.settings.erase("ranks");
  if (count > 0) p.job.settings["ranks"] = static_cast<double>(count);
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  Outcome out;
  out.exit_code = test::shell("'" + (count > 0 ? over_ranks : one_process) + "' --run '" +
                              folder.at("job.json") + "' 2> '" + folder.at("stderr") + "'");
  out.result = read_result(folder.at("result.json"));
  if (out.exit_code == 0) out.trajectory = read_trajectory(folder.at("trajectory.h5"));
  return out;
}

TEST(Ranks, GoOnFromACheckpointOnAnyNumberOfThem) {
  NEEDS_RANKS();
  for (Prepared p : {test::brittle_bar(true, Mode::corrected), test::merging_and_splitting(SolidKind::rigid),
                     test::ringing_bar()}) {
    const Outcome unbroken = run_on(2, p);
    ASSERT_EQ(unbroken.exit_code, 0) << unbroken.result.message;
    p.job.settings["checkpoint_interval"] = 0.55 * p.job.scene.end_time;
    p.job.settings["ranks"] = 2.0;
    const test::Folder folder;
    write_particles(folder.at("particles.h5"), p.initial);
    write_job(folder.at("job.json"), p.job);
    ASSERT_EQ(test::shell("'" + over_ranks + "' --run '" + folder.at("job.json") + "' 2> '" +
                          folder.at("stderr") + "'"),
              0);
    EXPECT_EQ(read_result(folder.at("result.json")).state_hash, unbroken.result.state_hash)
        << "a checkpoint changes no bit";
    for (const int count : {1, 2, 4}) {
      SCOPED_TRACE(std::to_string(count) + " ranks");
      const Outcome rest = go_on(folder, p, count);
      ASSERT_EQ(rest.exit_code, 0) << rest.result.message;
      EXPECT_GT(rest.result.extra.at("resumed_at"), 0.5 * p.job.scene.end_time);
      expect_equal(unbroken, rest, shared);
    }
  }
}

/// Runs the job of that folder and sends these signals to the engine once the last rank has told that it
/// steps. @return its exit code
int run_stopped(const test::Folder& folder, const std::vector<int>& signals) {
  int code = -1;
  std::thread engine([&] {
    code = test::shell("'" + over_ranks + "' --run '" + folder.at("job.json") + "' 2> '" +
                       folder.at("stderr") + "' & echo $! > '" + folder.at("process") + "'; wait $!");
  });
  bool steps = false;
  for (int tries = 0; tries < 6000 && !steps; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    steps = test::text_of(folder.at("rank-1.log")).find("step") != std::string::npos;
  }
  EXPECT_TRUE(steps) << "rank 1 never said that it steps";
  for (const int signal : signals)
    if (steps) ::kill(static_cast<pid_t>(std::stol(test::text_of(folder.at("process")))), signal);
  engine.join();
  return code;
}

TEST(Ranks, LeaveACheckpointWhereTheyAreStopped) {
  NEEDS_RANKS();
  Prepared p = test::merging_and_splitting(SolidKind::rigid);
  p.job.scene.time_step = 2e-5;  // so many steps that it is stopped among them
  const Outcome unbroken = run_on(2, p);
  ASSERT_EQ(unbroken.exit_code, 0) << unbroken.result.message;
  p.job.settings["ranks"] = 2.0;
  const test::Folder folder;
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  EXPECT_EQ(run_stopped(folder, {SIGTERM}), 130) << "as the engine tripoint";
  const Result result = read_result(folder.at("result.json"));
  EXPECT_EQ(result.status, Status::error);
  EXPECT_TRUE(result.message.starts_with("interrupted at t = ")) << result.message;
  EXPECT_NE(result.message.find("continue with --resume "), std::string::npos) << result.message;
  for (const int count : {2, 1, 0}) {
    SCOPED_TRACE(std::to_string(count) + " ranks");
    const Outcome rest = go_on(folder, p, count);
    ASSERT_EQ(rest.exit_code, 0) << rest.result.message;
    EXPECT_LT(rest.result.extra.at("resumed_at"), p.job.scene.end_time);
    EXPECT_EQ(rest.result.state_hash, unbroken.result.state_hash);
  }
}

/// A terminal that closes is told by the system and by the shell.
TEST(Ranks, LeaveACheckpointWhereTheirTerminalCloses) {
  NEEDS_RANKS();
  Prepared p = test::merging_and_splitting(SolidKind::rigid);
  p.job.scene.time_step = 2e-5;
  p.job.settings["ranks"] = 2.0;
  const test::Folder folder;
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  const auto before = ::signal(SIGHUP, SIG_DFL);  // nohup has it ignored, and that is handed down
  EXPECT_EQ(run_stopped(folder, {SIGHUP, SIGHUP}), 130);
  ::signal(SIGHUP, before);
  const Result result = read_result(folder.at("result.json"));
  EXPECT_TRUE(result.message.starts_with("interrupted at t = ")) << result.message;
  const std::string checkpoint = result.message.substr(result.message.rfind(' ') + 1);
  EXPECT_TRUE(std::filesystem::exists(folder.at(std::filesystem::path(checkpoint).filename())))
      << result.message;
}

TEST(Ranks, RefuseACheckpointOfAnotherScene) {
  NEEDS_RANKS();
  Prepared p = test::brittle_bar(false, Mode::corrected);
  p.job.settings["checkpoint_interval"] = 0.55 * p.job.scene.end_time;
  p.job.settings["ranks"] = 2.0;
  const test::Folder folder;
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  ASSERT_EQ(test::shell("'" + over_ranks + "' --run '" + folder.at("job.json") + "' 2> '" +
                        folder.at("stderr") + "'"),
            0);
  p.job.scene.materials[0].density = 999.0;
  const Outcome refused = go_on(folder, p, 2);
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.result.message.find("is of another scene"), std::string::npos) << refused.result.message;
}

}  // namespace
}  // namespace tripoint
