// SPDX-License-Identifier: BSD-3-Clause
// Changes that physics does not feel: each is undone exactly, is refused where it is no symmetry, and is felt
// by a solver that has an axis, an order or a unit of its own.
#include <gtest/gtest.h>

#include <set>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/campaign/case_run.hpp"
#include "validation/campaign/invariance.hpp"
#include "validation/mutation/selftest.hpp"

namespace tripoint {
namespace {

/// Particles without any symmetry, of two bodies, with the columns that trajectories have.
ChangedScene lopsided() {
  ChangedScene c;
  c.scene.gravity = {0.25, -1.0, -9.75};
  c.scene.min = Vec3{-1.0, -2.0, -3.0};
  c.scene.max = Vec3{1.5, 2.5, 3.5};
  c.scene.periodic = {false, true, false};
  c.scene.spacing = 0.1;
  c.scene.end_time = 2.0;
  c.scene.output_interval = 0.5;
  c.scene.time_step = 0.01;
  for (int i = 0; i < 7; ++i) {
    const double n = i;
    c.initial.position.push_back({0.1 * n, 0.3 - 0.01 * n * n, 1.0 / (1.0 + n)});
    c.initial.velocity.push_back({1.0 - n, 0.5 * n, 0.125 * n * n});
    c.initial.mass.push_back(1.0 + n);
    c.initial.phase.push_back(2);
    c.initial.body.push_back(i % 2);
    c.initial.material.push_back(0);
    c.initial.source.push_back(i % 2);
  }
  return c;
}

/// A frame that shows a scene's own start, and a body of it.
Snapshot seen(const ChangedScene& c) {
  Snapshot s;
  s.position = c.initial.position;
  s.velocity = c.initial.velocity;
  s.mass = c.initial.mass;
  s.phase = c.initial.phase;
  s.body = c.initial.body;
  s.material = c.initial.material;
  s.density = c.initial.mass;
  s.pressure = c.initial.mass;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    s.id.push_back(static_cast<int>(i));
    s.total_mass += s.mass[i];
    s.momentum += s.mass[i] * s.velocity[i];
    s.angular_momentum += s.mass[i] * cross(s.position[i], s.velocity[i]);
    s.energy["kinetic"] += 0.5 * s.mass[i] * dot(s.velocity[i], s.velocity[i]);
  }
  return s;
}

double difference(const Vec3& a, const Vec3& b) { return norm(a - b); }

TEST(Invariance, TheStartOfAChangedSceneTakenBackIsTheStart) {
  for (const auto& change : invariance_changes()) {
    const auto before = lopsided();
    auto changed = before;
    change.apply(changed);
    Trajectory run{{seen(changed)}};
    change.take_back(before, run);
    const auto &now = run.frames.front(), truth = seen(before);
    EXPECT_EQ(now.id, truth.id) << change.name;
    EXPECT_EQ(now.body, truth.body) << change.name;
    EXPECT_EQ(now.mass, truth.mass) << change.name;
    for (std::size_t i = 0; i < truth.position.size(); ++i) {
      // a unit in the last place of 1 m
      EXPECT_LE(difference(now.position[i], truth.position[i]), 1e-15) << change.name;
      EXPECT_LE(difference(now.velocity[i], truth.velocity[i]), 1e-14) << change.name;
    }
    // Sums of 7 terms of 100 kg m/s
    EXPECT_LE(difference(now.momentum, truth.momentum), 1e-12) << change.name;
    EXPECT_LE(difference(now.angular_momentum, truth.angular_momentum), 1e-12) << change.name;
    EXPECT_NEAR(now.energy.at("kinetic"), truth.energy.at("kinetic"), 1e-11) << change.name;
  }
}

TEST(Invariance, AChangeChangesWhatTheEngineIsGiven) {
  for (const auto& change : invariance_changes()) {
    const auto before = lopsided();
    auto changed = before;
    change.apply(changed);
    EXPECT_TRUE(state_hash(changed.initial) != state_hash(before.initial) ||
                changed.threads != before.threads)
        << change.name;
  }
}

TEST(Invariance, GravityAndTheDomainTurnWithTheScene) {
  auto turned = lopsided();
  invariance_change("rotation").apply(turned);
  EXPECT_EQ(turned.scene.gravity, (Vec3{-9.75, 0.25, -1.0}));
  EXPECT_EQ(*turned.scene.min, (Vec3{-3.0, -1.0, -2.0}));
  EXPECT_EQ(turned.scene.periodic, (std::array<bool, 3>{false, false, true}));
  auto mirrored = lopsided();
  invariance_change("mirror").apply(mirrored);
  EXPECT_EQ(mirrored.scene.gravity, (Vec3{-0.25, -1.0, -9.75}));
  EXPECT_EQ(mirrored.scene.min->x, -1.5);
  EXPECT_EQ(mirrored.scene.max->x, 1.0);
}

TEST(Invariance, ASpinIsAnAxialVector) {
  const auto before = lopsided();
  Snapshot s;
  s.bodies.resize(1);
  s.bodies[0].angular_velocity = {1.0, 2.0, 3.0};
  s.bodies[0].orientation = from_rotation_vector({0.1, 0.2, 0.3});
  Trajectory run{{s}};
  invariance_change("mirror").take_back(before, run);
  EXPECT_EQ(run.frames[0].bodies[0].angular_velocity, (Vec3{1.0, -2.0, -3.0}));
  const Vec3 r{0.3, -0.4, 0.5},
      // Mirror, turn by the mirrored rotation, mirror: the turn itself
      turned = rotate(s.bodies[0].orientation, r);
  const Vec3 way_round = rotate(run.frames[0].bodies[0].orientation, {-r.x, r.y, r.z});
  EXPECT_LE(difference({-way_round.x, way_round.y, way_round.z}, turned), 1e-15);
}

TEST(Invariance, IsRefusedWhereItIsNoSymmetry) {
  auto c = lopsided();
  EXPECT_NE(invariance_change("boost").refusal(c.scene), "");  // periodic, and gravity
  c.scene.periodic = {};
  c.scene.gravity = {};
  EXPECT_EQ(invariance_change("boost").refusal(c.scene), "");
  c.scene.bodies.resize(1);
  c.scene.bodies[0].motion = Motion::fixed;
  EXPECT_NE(invariance_change("boost").refusal(c.scene), "");
  EXPECT_EQ(invariance_change("mirror").refusal(c.scene), "");
  c.scene.inflows.resize(1);
  for (const char* name : {"mirror", "rotation", "units"})
    EXPECT_NE(invariance_change(name).refusal(c.scene), "") << name;
}

TEST(Invariance, AnUnknownChangeIsRefusedAsTheFileIsReadWithTheAllowedWords) {
  const TestFolder folder;
  try {
    (void)read_flight_case(folder, "[[harmless]]\nname = \"shuffle\"\n");
    FAIL() << "the name was taken";
  } catch (const InputError& e) {
    for (const auto& change : invariance_changes())
      EXPECT_NE(std::string(e.what()).find(change.name), std::string::npos) << e.what();
  }
}

TEST(Invariance, EveryWordOfTheCaseFileIsAChange) {
  const TestFolder folder;
  std::string all;
  for (const auto& change : invariance_changes())
    all += "[[harmless]]\nname = \"" + std::string(change.name) + "\"\n";
  const auto value = read_flight_case(folder, all);
  ASSERT_EQ(value.harmless.size(), invariance_changes().size());
  for (const auto& name : value.harmless) EXPECT_EQ(invariance_change(name).name, name);
  EXPECT_THROW((void)invariance_change("rigid.order"), InputError);
}

CaseResult judged_case(double measured, const std::string& hash = "a") {
  auto r = green();
  error(r).value = measured;
  engine(r).runs[0].state_hash = hash;
  judge(r);
  return r.cases[0];
}

TEST(Invariance, AMetricThatChangesByMoreThanRoundOffIsFelt) {
  const auto& order = invariance_change("order");
  EXPECT_TRUE(judge_invariance(order, judged_case(0.05), judged_case(0.05 + 0.5 * order.tolerance)).borne);
  EXPECT_FALSE(judge_invariance(order, judged_case(0.05), judged_case(0.05 + 2.0 * order.tolerance))
                   .borne);  // green, and yet another answer
  EXPECT_FALSE(judge_invariance(order, judged_case(0.05), judged_case(not_a_number)).borne);
}

TEST(Invariance, AGateThatTurnsRedIsFeltHoweverSmallTheChange) {
  const auto& order = invariance_change("order");
  EXPECT_FALSE(judge_invariance(order, judged_case(0.1), judged_case(0.1 + 0.5 * order.tolerance)).borne);
}

TEST(Invariance, ThreadsMustKeepEveryBit) {
  const auto& threads = invariance_change("threads");
  EXPECT_TRUE(judge_invariance(threads, judged_case(0.05), judged_case(0.05)).borne);
  EXPECT_FALSE(judge_invariance(threads, judged_case(0.05), judged_case(0.05, "b")).borne);
}

TEST(Invariance, ARunThatIsNotThereIsFelt) {
  const auto& order = invariance_change("order");
  auto gone = judged_case(0.05);
  gone.engines[0].runs.clear();
  EXPECT_FALSE(judge_invariance(order, judged_case(0.05), gone).borne);
  auto unjudged = judged_case(0.05);
  unjudged.engines[0].gates.clear();
  EXPECT_FALSE(judge_invariance(order, unjudged, unjudged).borne);
}

/// The flight against its parabola, on our own solver, changed and taken back.
TEST(Invariance, AFlightBearsWhatItsSceneAllowsAndTheBoostOfWhatFallsIsRefused) {
  const auto engine = ask_engine(program_folder() + "/../libexec/tripoint/engine-tripoint");
  ASSERT_TRUE(engine.available) << engine.reason;
  const TestFolder folder;
  std::string names;
  for (const auto& change : invariance_changes())
    names += "[[harmless]]\nname = \"" + std::string(change.name) + "\"\n";
  SelftestOptions options;
  options.out = folder / "out";
  for (const auto& row : try_invariance(read_flight_case(folder, names), engine, options))
    EXPECT_EQ(row.borne, row.change != "boost") << row.change << ": " << row.found;
}

TEST(Invariance, ASolverWithAnAxisOfItsOwnFeelsTheRotation) {
  const TestFolder folder;
  SelftestOptions options;
  options.out = folder / "out";
  auto biased = ask_engine(fake_engine(folder, "knows which way is up", "tripoint"));
  ASSERT_TRUE(biased.available) << biased.reason;
  const auto rows =
      try_invariance(read_flight_case(folder, "[[harmless]]\nname = \"rotation\"\n"), biased, options);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].borne);
  // Its error along z, gone along x
  EXPECT_NEAR(rows[0].greatest, 0.5 * 0.01 * 9.81 * 0.5 * 0.5, 1e-9) << rows[0].found;
}

TEST(Invariance, RunsOfOneStartHaveFilesOfTheirOwn) {
  const TestFolder folder;
  const auto value = read_flight_case(
      folder,
      // Other steps, one start
      "[[study]]\naxis = \"time_step\"\nlevels = [0.02, 0.01, 0.005]\nmetric = \"position\"\n");
  EngineEntry ours;
  ours.name = "tripoint";
  ours.available = true;
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"tripoint"};
  const auto changes = invariance_changes();
  options.change = &changes.front();
  const CaseRuns all = prepare_case(value, {ours}, options);
  std::set<std::string> files;
  for (const CaseRun& run : all.runs) files.insert(run.changed->particles);
  EXPECT_GT(all.runs.size(), 1u);
  EXPECT_EQ(files.size(), all.runs.size());
}

TEST(Invariance, AFeltChangeEndsTheSelfTestWithFive) {
  const TestFolder folder;
  SelftestOptions options;
  options.out = folder / "out";
  options.what = {folder / "cases/test/flight.toml"};
  write_text(options.what.front(), flight_case("[[harmless]]\nname = \"rotation\"\n"));
  options.engine = fake_engine(folder, "nothing", "tripoint");
  EXPECT_EQ(run_selftest(options).exit_code, exit_pass);
  options.engine = fake_engine(folder, "knows which way is up", "tripoint");
  const auto outcome = run_selftest(options);
  EXPECT_EQ(outcome.exit_code, exit_selftest);
  EXPECT_NE(selftest_table(outcome).find("FELT"), std::string::npos);
}

}  // namespace
}  // namespace tripoint
