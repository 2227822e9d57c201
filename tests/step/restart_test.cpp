// SPDX-License-Identifier: BSD-3-Clause
// A run that is cut and continued must be the run that was never cut. Each cut is compared with ONE unbroken
// run, in every number of its whole state; a second run that sets up anew on both sides would hide what is
// wrong with the first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include "core/not_a_number.hpp"
#include "effects/lab.hpp"
#include "files/checkpoint_file.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

struct Journey {
  lab::Lab lab;
  std::vector<double> times;  ///< output times, which the steps meet [s]
};

/// The state at the end of a run, and the states at some of its steps.
struct Course {
  Checkpoint end;
  std::map<long, Checkpoint> cuts;
  long steps = 0;
};

Course follow(Simulation& s, const std::vector<double>& times, const std::vector<long>& cut_at) {
  Course course;
  const auto between = [&] {
    if (std::ranges::count(cut_at, s.steps())) course.cuts[s.steps()] = s.checkpoint();
    return true;
  };
  for (const double time : times) s.advance_to(time, between);
  course.end = s.checkpoint();
  course.steps = s.steps();
  return course;
}

Course unbroken(const Journey& j, int threads, const std::vector<long>& cut_at = {}) {
  Simulation s(j.lab.scene, j.lab.initial, {.threads = threads});
  return follow(s, j.times, cut_at);
}

Course continued(const Journey& j, int threads, const Checkpoint& from,
                 const std::vector<long>& cut_at = {}) {
  Simulation s(j.lab.scene, j.lab.initial, {.threads = threads}, from);
  return follow(s, j.times, cut_at);
}

std::vector<long> random_steps(long last, unsigned seed, std::size_t count = 10) {
  std::mt19937 random(seed);
  std::vector<long> steps;
  while (steps.size() < count) {
    const long at = 1 + static_cast<long>(random() % static_cast<unsigned>(last - 1));
    if (!std::ranges::count(steps, at)) steps.push_back(at);
  }
  return steps;
}

/// Names of the arrays whose bits differ.
std::string differences(const Checkpoint& a, const Checkpoint& b) {
  std::string names;
  const auto compare = [&](const auto& x, const auto& y) {
    for (const auto& [name, values] : x)
      if (!y.count(name) ||
          std::memcmp(values.data(), y.at(name).data(), values.size() * sizeof(values[0])) != 0)
        names += name + " ";
  };
  compare(a.real, b.real);
  compare(a.whole, b.whole);
  return names;
}

/// Two blocks that spin and conduct past each other in a periodic box, merge, and split again; one end is
/// heated for a while.
Journey flight_with_events(Mode mode) {
  lab::Lab lab(1e-3, mode);
  lab.scene.gravity = {0.0, 0.0, -1e-3};
  lab.make_periodic({true, true, false}, {0.0, 0.0, 0.0}, {16, 12, 8});
  lab.add_material(300.0, 5.0, 800.0);
  lab.add({.name = "a",
           .count = {6, 6, 6},
           .velocity = {0.02, 0.001, 0.0},
           .angular_velocity = {0.5, 1.0, 2.0},
           .temperature = [](const Vec3& r) { return 300.0 + 1e4 * r.x; }});
  lab.add({.name = "b",
           .material = 1,
           .corner = {8e-3, 0.0, 0.0},
           .count = {5, 6, 6},
           .velocity = {-0.02, 0.0, 0.001},
           .temperature = [](const Vec3&) { return 350.0; }});
  Event heat;
  heat.kind = Event::Kind::heat;
  heat.time = 0.05;
  heat.until = 0.21;
  heat.bodies = {"a"};
  heat.temperature = 400.0;
  Event merge;
  merge.kind = Event::Kind::merge;
  merge.time = 0.13;
  merge.bodies = {"a", "b"};
  Event split;
  split.kind = Event::Kind::split;
  split.time = 0.3;
  split.name = "born";
  split.bodies = {"a"};
  split.region = Shape{};
  split.region->kind = Shape::Kind::half_space;
  split.region->point = {7e-3, 0, 0};
  split.region->normal = {1, 0, 0};
  lab.scene.events = {heat, merge, split};
  return {lab, {0.1, 0.2, 0.4, 0.5}};
}

/// A spinning block in vacuum, no pairs: merges with a second and loses a part.
Journey bodies_only() {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.gravity = {0.0, 0.0, -9.81};
  lab.scene.time_step = 0.01;
  lab.add({.name = "second", .corner = {2.0, 0.0, 0.0}, .count = {3, 3, 3}, .velocity = {-1.0, 0.0, 0.0}});
  Event merge;
  merge.kind = Event::Kind::merge;
  merge.time = 0.313;
  merge.bodies = {"block", "second"};
  Event split;
  split.kind = Event::Kind::split;
  split.time = 0.72;
  split.name = "born";
  split.region = Shape{};
  split.region->kind = Shape::Kind::half_space;
  split.region->point = {1.0, 0, 0};
  split.region->normal = {-1, 0, 0};
  lab.scene.events = {merge, split};
  return {lab, {0.25, 0.5, 1.0}};
}

/// Liquid between walls in a periodic channel with a light free body in it, and gravity.
Journey liquid_with_body(ViscosityForm form = ViscosityForm::central, bool with_body = true) {
  lab::Lab lab(0.05);
  lab.scene.gravity = {0.2, 0.0, -2.0};
  lab.scene.viscosity_form = form;
  lab.scene.jitter = 0.0;
  lab.scene.materials[0].viscosity = 5.0;
  lab.scene.materials[0].stiffness = 100.0;
  lab.scene.materials[0].conductivity.reset();
  lab.add_material(500.0, 1.0, 1.0);
  lab.scene.materials[1].conductivity.reset();
  lab.make_periodic({true, true, false}, {0.0, 0.0, 0.0}, {6, 6, 20});
  lab.add({.name = "water", .count = {6, 6, 8}, .phase = Phase::liquid, .velocity = {0.6, 0.0, 0.0}});
  lab.add({.name = "floor", .corner = {0.0, 0.0, -0.15}, .count = {6, 6, 3}, .motion = Motion::fixed});
  if (with_body)
    lab.add({.name = "float",
             .material = 1,
             .corner = {0.1, 0.1, 0.45},
             .count = {2, 2, 2},
             .velocity = {0.0, 0.0, -0.5}});
  return {lab, {0.03, 0.1, 0.16}};
}

/// Two liquids on a floor, and a soft cube in the upper one, pressed at its faces.
Journey two_liquids_with_a_soft_cube() {
  Journey j = liquid_with_body(ViscosityForm::central, false);
  lab::Lab& lab = j.lab;
  lab.scene.values["face_pressure"] = lab.scene.values["interface_weight"] = 1.0;
  lab.scene.materials[1].young_modulus = 1e4;
  lab.scene.materials[1].poisson_ratio = 0.3;
  lab.scene.materials[1].solid = SolidKind::elastic;
  lab.add(
      {.name = "oil", .material = 1, .corner = {0.0, 0.0, 0.4}, .count = {6, 6, 3}, .phase = Phase::liquid});
  lab.add({.name = "cube",
           .material = 1,
           .corner = {0.06, 0.06, 0.54},
           .count = {3, 3, 3},
           .phase = Phase::elastic,
           .velocity = {0.0, 0.0, -1.0}});
  j.times = {0.03, 0.08};
  return j;
}

/// Two fixed blocks, one held hot: the other melts, and conducts and holds heat otherwise when it has.
Journey melting_of_unlike_phases() {
  lab::Lab lab(0.1);
  Material& m = lab.scene.materials[0];
  m.conductivity = 1000.0;
  m.solid_conductivity = 3000.0;
  m.solid_heat_capacity = 500.0;
  m.t_melt = m.t_solid = 350.0;
  m.latent_heat = 2e4;
  lab.add_material(1000.0, 1000.0, 1000.0);
  lab.add({.name = "bar", .count = {6, 3, 3}, .motion = Motion::fixed, .temperature = [](const Vec3&) {
             return 345.0;
           }});
  lab.add({.name = "hot",
           .material = 1,
           .corner = {-0.3, 0.0, 0.0},
           .count = {3, 3, 3},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 380.0; },
           .temperature_held = true});
  lab.scene.bodies[0].temperature->value = 380.0;
  lab.make_periodic({false, true, true}, {-0.3, 0.0, 0.0}, {9, 3, 3});
  return {lab, {20.0, 40.0, 60.0}};
}

/// Two cubes that meet, in steps that are short while they touch.
Journey hit() {
  lab::Lab lab(0.1);
  lab.scene.materials[0].stiffness = 1000.0;
  lab.scene.materials[0].conductivity.reset();
  lab.scene.values["contact_stiffness"] = 24.0;
  lab.scene.values["contact_step"] = 0.5;
  lab.add(
      {.name = "left", .count = {3, 3, 3}, .velocity = {1.5, 0.0, 0.0}, .angular_velocity = {0.0, 0.5, 0.0}});
  lab.add({.name = "right", .corner = {0.8, 0.0, 0.03}, .count = {3, 3, 3}, .velocity = {-1.5, 0.0, 0.0}});
  return {lab, {0.3, 0.5}};
}

/// Two blocks in a chain that hangs from the world, with a spring and a motor in one hinge.
Journey chain_of_joints() {
  lab::Lab lab = lab::asymmetric_block({0.0, 0.0, 0.0});
  lab.scene.gravity = {0.0, 0.0, -9.81};
  lab.scene.time_step = 0.01;
  lab.scene.contact = false;
  lab.add({.name = "second", .corner = {2.0, 0.0, 0.0}, .count = {3, 3, 3}});
  Joint hinge;
  hinge.name = "hinge";
  hinge.bodies = {"block", "world"};
  hinge.point = {-0.5, 0.0, 0.0};
  hinge.axis = Vec3{0.0, 1.0, 0.0};
  hinge.spring = JointSpring{3.0, 0.2};
  hinge.motor = JointMotor{1.5, {}};
  Joint ball;
  ball.kind = Joint::Kind::ball;
  ball.name = "ball";
  ball.bodies = {"second", "block"};
  ball.point = {1.0, 0.1, 0.0};
  lab.scene.joints = {hinge, ball};
  return {lab, {0.25, 0.5, 1.0}};
}

/// 10 random cuts; every one continued on 1 and on 2 threads, whatever the unbroken run had.
void expect_same_bits(const Journey& j, unsigned seed) {
  const Course whole = unbroken(j, 1);
  ASSERT_GT(whole.steps, 20) << "too few steps to cut";
  const std::vector<long> cuts = random_steps(whole.steps, seed);
  for (const int threads : {1, 2}) {
    const Course watched = unbroken(j, threads, cuts);
    ASSERT_EQ(watched.cuts.size(), cuts.size());
    EXPECT_TRUE(same_bits(watched.end, whole.end))
        << "taking checkpoints, on " << threads << " threads: " << differences(whole.end, watched.end);
    for (const auto& [step, checkpoint] : watched.cuts) {
      const Course rest = continued(j, 3 - threads, checkpoint);
      EXPECT_TRUE(same_bits(rest.end, whole.end))
          << "cut at step " << step << " of " << whole.steps << ": " << differences(whole.end, rest.end);
    }
  }
}

TEST(Restart, OfBodiesThatMergeAndSplitIsTheUnbrokenRun) { expect_same_bits(bodies_only(), 1); }

TEST(Restart, OfBodiesWithJointsIsTheUnbrokenRun) { expect_same_bits(chain_of_joints(), 11); }

TEST(Restart, OfJointsThatRubAndHitTheirLimitsIsTheUnbrokenRun) {
  Journey j = chain_of_joints();
  Joint& hinge = j.lab.scene.joints[0];
  hinge.limits = {-0.1, 0.3};
  hinge.restitution = hinge.friction = hinge.damping = 0.5;
  expect_same_bits(j, 12);
}

TEST(Restart, OfBodiesThatConductWhileTheyMoveMergeAndSplitIsTheUnbrokenRun) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const Journey j = flight_with_events(mode);
    const auto rebuilds = unbroken(j, 1).end.whole.at("neighbours/rebuilds")[0];
    EXPECT_GT(rebuilds, 3) << "the lists must have been built anew for this to prove anything";
    expect_same_bits(j, 2);
  }
}

TEST(Restart, OfALiquidWithAFreeBodyIsTheUnbrokenRun) {
  const Journey j = liquid_with_body();
  EXPECT_GT(unbroken(j, 1).end.whole.at("neighbours/rebuilds")[0], 2)
      << "the lists must have been built anew for this to prove anything";
  expect_same_bits(j, 3);
}

TEST(Restart, OfLiquidsOfTwoDensitiesAndASoftCubeInThemIsTheUnbrokenRun) {
  const Journey j = two_liquids_with_a_soft_cube();
  EXPECT_GT(unbroken(j, 1).end.whole.at("neighbours/rebuilds")[0], 2)
      << "the lists must have been built anew for this to prove anything";
  expect_same_bits(j, 8);
}

TEST(Restart, OfALiquidThatTheTransportVelocityMovesIsTheUnbrokenRun) {
  Journey j = liquid_with_body(ViscosityForm::central, false);
  j.lab.scene.modes[term::clamp] = Mode::paper;
  j.lab.scene.transport_velocity = true;
  j.lab.scene.values["mean_pressure"] = 1.0;
  j.lab.scene.values["sound_damping"] = 0.2;
  expect_same_bits(j, 2);
}

TEST(Restart, OfAHitInStepsThatAreShortAtATouchIsTheUnbrokenRun) {
  const Journey j = hit();
  Journey everywhere = j;
  everywhere.lab.scene.values["contact_step"] = 0.0;
  EXPECT_LT(unbroken(j, 1).steps, unbroken(everywhere, 1).steps / 2)
      << "steps must be long elsewhere for this to prove anything";
  expect_same_bits(j, 9);
}

TEST(Restart, OfMeltingWithUnlikePhasesIsTheUnbrokenRun) {
  const Journey j = melting_of_unlike_phases();
  const auto f = unbroken(j, 1).end.real.at("particles/liquid_fraction");
  EXPECT_TRUE(std::ranges::any_of(f, [](double x) { return x > 0.0; }))
      << "something must melt for this to prove anything";
  expect_same_bits(j, 7);
}

TEST(Restart, OfALiquidBetweenExtrapolatedWallsIsTheUnbrokenRun) {
  expect_same_bits(liquid_with_body(ViscosityForm::laplacian, false), 4);
}

TEST(Restart, OfARestartIsTheUnbrokenRun) {
  for (const Journey& j : {bodies_only(), flight_with_events(Mode::corrected), liquid_with_body()}) {
    const Course whole = unbroken(j, 1);
    std::vector<long> cuts = random_steps(whole.steps, 5, 4);
    std::ranges::sort(cuts);
    Checkpoint last = unbroken(j, 1, {cuts[0]}).cuts.at(cuts[0]);
    for (std::size_t n = 1; n < cuts.size(); ++n)
      last = continued(j, 1 + static_cast<int>(n) % 2, last, {cuts[n]}).cuts.at(cuts[n]);
    const Course rest = continued(j, 1, last);
    EXPECT_TRUE(same_bits(rest.end, whole.end)) << differences(whole.end, rest.end);
  }
}

TEST(Restart, AtEveryStepOfAShortRunIsTheUnbrokenRun) {
  Journey j = flight_with_events(Mode::corrected);  // heat begins at 0.05 s and the bodies merge at 0.13 s
  j.times = {0.06, 0.135};
  const long last = unbroken(j, 1).steps;
  std::vector<long> all;
  for (long step = 1; step <= last; ++step) all.push_back(step);
  const Course whole = unbroken(j, 2, all);
  for (const auto& [step, checkpoint] : whole.cuts)
    EXPECT_TRUE(same_bits(continued(j, 2, checkpoint).end, whole.end))
        << "cut at step " << step << " of " << last;
}

TEST(Restart, KeepsAParticleThatARoundingErrorPutOnTheUpperEdgeOfThePeriodicBox) {
  lab::Lab lab(1e-3);
  lab.make_periodic({true, false, false}, {0.5e-3, 0.0, 0.0}, {8, 8, 8});  // the box begins at x = 0
  lab.add({.name = "a", .count = {4, 4, 4}, .velocity = {0.02, 0.0, 0.0}, .temperature = [](const Vec3& r) {
             return 300.0 + 1e4 * r.x;
           }});
  for (Vec3& r : lab.initial.position)
    if (r.x == 0.0) r.x = -1e-20;
  lab.scene.time_step = 2e-4;  // the first lists last for 32 steps
  const Journey j{lab, {0.004, 0.008}};
  expect_same_bits(j, 6);
}

TEST(Restart, TakesNoCheckpointOfAnotherLayoutOrScene) {
  const Journey warm = flight_with_events(Mode::corrected), printed = flight_with_events(Mode::paper),
                other = bodies_only();
  const Checkpoint kept = unbroken(warm, 1, {5}).cuts.at(5);
  for (const Journey* j : {&printed, &other}) EXPECT_THROW(continued(*j, 1, kept), InputError);
  Checkpoint twice = kept;
  twice.whole.at("particles/id")[0] = twice.whole.at("particles/id")[1];
  EXPECT_THROW(continued(warm, 1, twice), InputError);
  Checkpoint shorter = kept;
  shorter.real.at("particles/mass").pop_back();
  EXPECT_THROW(continued(warm, 1, shorter), InputError);
}

/// As a file could say whose seal holds. Each is one number of a state from which the run went on before.
TEST(Restart, RefusesRowsThatAreNotThereAndAmountsThatNoFormulaBears) {
  const Journey j = two_liquids_with_a_soft_cube();
  const Checkpoint kept = unbroken(j, 1, {5}).cuts.at(5);
  EXPECT_NO_THROW(continued(j, 1, kept));
  const std::vector<std::pair<std::string, std::int64_t>> rows{
      {"particles/body", 1000},      {"particles/body", -2},           {"particles/phase", 3},
      {"particles/material", 99},    {"particles/source", 1 << 20},    {"particles/source", -1},
      {"particles/shape_rank", 4},   {"particles/solid_material", 99}, {"particles/material", 1LL << 32},
      {"bodies/body.motion", 3},     {"bodies/body.phase", -1},        {"bodies/body.source", 99},
      {"bodies/body.alive", 2},      {"bonds/count", 1LL << 61},       {"bonds/count", -1},
      {"own_pairs/count", 1LL << 61}};
  for (const auto& [name, value] : rows) {
    ASSERT_TRUE(kept.whole.count(name)) << name;
    Checkpoint wrong = kept;
    wrong.whole.at(name).back() = value;
    EXPECT_THROW(continued(j, 1, wrong), InputError) << name << " = " << value;
  }
  for (const double mass : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity(), 5e-324}) {
    Checkpoint wrong = kept;
    wrong.real.at("particles/mass")[0] = mass;
    EXPECT_THROW(continued(j, 1, wrong), InputError) << mass;
  }
  Checkpoint no_time = kept;
  no_time.real.at("step/time")[0] = not_a_number;
  EXPECT_THROW(continued(j, 1, no_time), InputError);
}

std::string refusal_of(const Journey& j, const Checkpoint& wrong) {
  try {
    continued(j, 1, wrong);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

/// Each effect says of its own columns what they hold: nobody else knows them.
TEST(Restart, RefusesWhatAnEffectSaysThatItsColumnsCannotHold) {
  Journey j = two_liquids_with_a_soft_cube();
  Event hold;
  hold.kind = Event::Kind::hold;
  hold.time = 1.0;
  hold.bodies = {"cube"};
  j.lab.scene.events = {hold};
  const Checkpoint kept = unbroken(j, 1, {5}).cuts.at(5);
  const auto said_of = [&](const std::string& name, int value) {
    Checkpoint wrong = kept;
    wrong.whole.at(name).back() = value;
    return refusal_of(j, wrong);
  };
  EXPECT_THAT(said_of("particles/driven", 3), testing::EndsWith(" is 3, not one of -1 to 2"));
  EXPECT_THAT(said_of("particles/driven", -2), testing::HasSubstr(": driven of row "));
  EXPECT_THAT(said_of("particles/shape_rank", 4), testing::EndsWith(" is 4, not one of 0 to 3"));
  EXPECT_EQ(said_of("bodies/body.grip", 2),
            "no run can go on from this checkpoint: body.grip of row 1 is 2, not one of 0 to 1");
  Checkpoint empty = kept;
  empty.real.at("particles/density").back() = 0.0;
  EXPECT_THAT(refusal_of(j, empty), testing::EndsWith(" is 0 kg/m3"));
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const Journey warm = flight_with_events(mode);
    Checkpoint cold = unbroken(warm, 1, {5}).cuts.at(5);
    cold.real.at("particles/heat_capacity").back() = -1.0;
    EXPECT_THAT(refusal_of(warm, cold), testing::EndsWith(" is -1 J/kg/K"));
  }
}

/// How many empty lists follow the last bond tells what had been, not what is: a run whose bonds have all
/// gone keeps them, and one that goes on from there has none.
TEST(Restart, KeepsNoListsOfBondsThatAreNoMore) {
  Journey j = two_liquids_with_a_soft_cube();
  j.lab.add({.name = "drop",
             .material = 1,
             .corner = {0.06, 0.06, 1.0},
             .count = {2, 2, 2},
             .phase = Phase::liquid});
  const Checkpoint kept = unbroken(j, 1, {5}).cuts.at(5);
  for (const char* lists : {"bonds/count", "own_pairs/count"}) {
    EXPECT_GT(kept.whole.at(lists).back(), 0) << lists;
    Checkpoint padded = kept;
    padded.whole.at(lists).resize(padded.whole.at(lists).size() + 7, 0);
    Simulation s(j.lab.scene, j.lab.initial, {}, padded);
    EXPECT_EQ(s.checkpoint().whole.at(lists), kept.whole.at(lists)) << lists;
  }
}

TEST(Restart, RefusesABondWhosePartnerIsNoParticleOrDoesNotKnowIt) {
  const Journey j = two_liquids_with_a_soft_cube();
  const Checkpoint kept = unbroken(j, 1, {5}).cuts.at(5);
  const std::vector<double>& bonds = kept.real.at("bonds/list");
  for (const std::uint64_t partner :
       {0xffffffffULL, 1ULL << 20, 1ULL << 32}) {  // its lower half is the partner, its upper the place there
    Checkpoint wrong = kept;
    wrong.real.at("bonds/list")[0] = std::bit_cast<double>(partner);
    ASSERT_NE(std::bit_cast<std::uint64_t>(bonds[0]), partner);
    EXPECT_THROW(continued(j, 1, wrong), InputError) << partner;
  }
  Checkpoint wrong = kept;
  wrong.real.at("own_pairs/list")[0] = std::bit_cast<double>(std::uint64_t{1} << 20);
  EXPECT_THROW(continued(j, 1, wrong), InputError);
}

TEST(Restart, StopsWhereItIsToldToAndGoesOnFromThere) {
  const Journey j = bodies_only();
  Simulation s(j.lab.scene, j.lab.initial);
  EXPECT_FALSE(s.advance_to(1.0, [&] { return s.steps() < 7; }));
  EXPECT_EQ(s.steps(), 7);
  EXPECT_TRUE(s.advance_to(1.0));
  Simulation whole(j.lab.scene, j.lab.initial);
  whole.advance_to(1.0);
  EXPECT_TRUE(same_bits(s.checkpoint(), whole.checkpoint()));
}

}  // namespace
}  // namespace tripoint
