// SPDX-License-Identifier: BSD-3-Clause
// The ways in which a gate never fails (notes on validation, section 2), as far as metrics, audit and
// verdicts can have them.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/not_a_number.hpp"
#include "metrics/fakes.hpp"
#include "validation/metrics/order.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Trial;

bool passes(const MetricValue& v, double limit) {
  return judge_limit(v.value, v.uncertainty.combined(), limit) == Verdict::pass;
}

Trial flight() { return {test::thrown_block(), "torque_free"}; }
Trial heat() { return {test::warm_bar(), "cosine_mode"}; }

TEST(GateThatNeverFails, NotANumberIsNoPass) {
  auto t = heat();
  t.run.frames.back().temperature[7] = not_a_number;
  EXPECT_FALSE(passes(t.value(metric("temperature", "L2")), 1e9));
  EXPECT_NE(t.sound(), "");
  auto f = flight();
  f.run.frames[4].position[3].y = not_a_number;
  EXPECT_FALSE(passes(f.value(metric("position", "max")), 1e9));
  EXPECT_FALSE(passes(f.value(metric("angular_momentum", "max")), 1e9));
  EXPECT_FALSE(passes(f.value(metric("shape", "max")), 1e9));
  EXPECT_FALSE(passes(f.value(metric("ledger.kinetic", "drift")), -1.0));
  EXPECT_NE(f.sound(), "");
  auto b = flight();
  b.run.frames.back().bodies[0].orientation.w = not_a_number;
  EXPECT_FALSE(passes(b.value(metric("orientation", "final", "block")), 1e9));
}

TEST(GateThatNeverFails, SamplesThatDoNotMatchAreNotDropped) {
  auto t = flight();
  t.run.frames.back().id[5] = -1;  // lost in the run, alive in truth
  t.run.frames.back().position[5] = {not_a_number, not_a_number, not_a_number};
  EXPECT_FALSE(passes(t.value(metric("position", "final")), 1e9));
  auto b = flight();
  b.run.frames.back().bodies[0].position = {not_a_number, not_a_number, not_a_number};
  EXPECT_FALSE(passes(b.value(metric("orientation", "final")), 1e9));
  EXPECT_FALSE(passes(b.value(metric("body_count", "final")), 0.0));
}

TEST(GateThatNeverFails, ArraysAreNotCutToTheShorterOne) {
  auto t = heat();
  t.run.frames.back().temperature.pop_back();
  EXPECT_FALSE(passes(t.value(metric("temperature", "L2")), 1e9));
  auto f = flight();
  for (auto* column : {&f.run.frames.back().position, &f.run.frames.back().velocity}) column->pop_back();
  EXPECT_FALSE(passes(f.value(metric("position", "final")), 1e9));
  EXPECT_NE(f.sound(), "");
}

TEST(GateThatNeverFails, AMissingResultIsNoZero) {
  auto t = heat();
  for (auto& f : t.run.frames) f.temperature.clear();
  EXPECT_FALSE(passes(t.value(metric("temperature", "L2")), 1e9));
  EXPECT_FALSE(passes(t.value(metric("decay_rate", "final")), 1e9));
  t.run.frames.clear();
  EXPECT_FALSE(passes(t.value(metric("temperature", "L2")), 1e9));
  EXPECT_NE(t.sound(), "");
  EXPECT_THROW((void)t.value(metric("temperatur", "L2")), InputError);
  EXPECT_THROW((void)t.value(metric("temperature", "l2")), InputError);
  EXPECT_THROW((void)t.value(metric("temperature", "L2", "bra")), InputError);
}

TEST(GateThatNeverFails, AMissingReferenceIsNoLimit) {
  const auto t = flight();
  EXPECT_FALSE(passes(t.value(metric("temperature", "L2")), 1e9));  // rigid flight knows no temperature
  EXPECT_FALSE(passes(t.value(metric("event_time", "final")), 1e9));
  EXPECT_FALSE(passes(t.value(metric("ledger.elastic", "max")), 1e9));
  ReferenceChoice none;
  EXPECT_THROW((void)make_reference(none, t.s.job, t.s.initial), InputError);
  none.function = "no_such";
  EXPECT_THROW((void)make_reference(none, t.s.job, t.s.initial), InputError);
}

TEST(GateThatNeverFails, EveryParticleAndEveryBodyIsCompared) {
  auto t = flight();
  t.run.frames.back().position.back() += Vec3{0, 0, 0.5};
  EXPECT_NEAR(t.value(metric("position", "final")).value, 0.5, 1e-12);
  auto s = test::thrown_block();
  test::add_body(s, "second", {{2, 2, 2}, 0.1, {3, 0, 0}, 1.0}, {{0, 1, 0}, {}});
  Trial two(s, "ballistic");
  two.run.frames.back().bodies[1].orientation = from_rotation_vector({0.3, 0, 0});
  EXPECT_NEAR(two.value(metric("orientation", "final")).value, 0.3, 1e-12);
}

TEST(GateThatNeverFails, ADeadRunIsNotAgreement) {
  auto t = flight();  // both sides zero: a run that shows zeros everywhere
  for (auto& f : t.run.frames) {
    std::fill(f.position.begin(), f.position.end(), Vec3{});
    std::fill(f.velocity.begin(), f.velocity.end(), Vec3{});
  }
  EXPECT_NE(t.sound(), "");
  EXPECT_FALSE(passes(t.value(metric("position", "max")), 0.01));
}

TEST(GateThatNeverFails, AFrozenSceneKeepsEverythingButIsFound) {
  auto t = flight();
  t.s.job.scene.gravity = {};
  for (auto& f : t.run.frames) {
    const double time = f.time;
    f = t.run.frames.front();
    f.time = time;
  }
  EXPECT_TRUE(passes(t.value(metric("ledger.kinetic", "drift")), 1e-12));  // conservation alone is blind
  EXPECT_NE(t.sound().find("frozen"), std::string::npos);
  auto h = heat();
  for (auto& f : h.run.frames) f.temperature = h.s.initial.temperature;
  EXPECT_NE(h.sound().find("frozen"), std::string::npos);
  EXPECT_FALSE(passes(h.value(metric("decay_rate", "final")), 0.5));
  auto half = flight();  // stops in mid-run
  for (std::size_t n = 6; n < half.run.frames.size(); ++n)
    half.run.frames[n].position = half.run.frames[5].position;
  EXPECT_NE(half.sound().find("frozen"), std::string::npos);
}

TEST(GateThatNeverFails, UnderPredictionFailsToo) {
  auto t = heat();
  auto slow = t.s;
  slow.job.scene.materials[0].conductivity = 1.8;
  t.run = test::perfect_run(slow, *make_reference(test::function("cosine_mode"), slow.job, slow.initial));
  const auto v = t.value(metric("decay_rate", "final"));
  EXPECT_NEAR(v.value, -0.1, 1e-9);
  EXPECT_FALSE(passes(v, 0.05));
}

TEST(GateThatNeverFails, ADivergingStudyHasANegativeOrder) {
  const auto fit = fit_order({0.1, 0.05, 0.025, 0.0125}, {1e-4, 4e-4, 1.6e-3, 6.4e-3}, {}, 2.0);
  EXPECT_EQ(judge_at_least(fit.value, 0.0, 1.8), Verdict::fail);
  EXPECT_EQ(fit.fit_class, FitClass::diverging);
}

TEST(GateThatNeverFails, AShiftedOrShortTimeAxisIsFound) {
  auto t = flight();
  t.run.frames.pop_back();
  EXPECT_NE(t.sound().find("time not reached"), std::string::npos);
  EXPECT_FALSE(passes(t.value(metric("position", "max")), 1e9));
  auto late = flight();
  for (auto& f : late.run.frames) f.time += 1e-3;
  EXPECT_NE(late.sound(), "");
  auto near = flight();  // within 1e-9 of the end is the same time
  for (auto& f : near.run.frames) f.time += 0.5e-9;
  EXPECT_EQ(near.sound(), "");
  auto back = flight();
  std::swap(back.run.frames[3], back.run.frames[4]);
  EXPECT_NE(back.sound(), "");
}

TEST(GateThatNeverFails, PermutedIdsAreFoundHoweverTheyAreWritten) {
  auto t = flight();
  std::swap(t.run.frames.back().id[2], t.run.frames.back().id[9]);
  EXPECT_NE(t.sound().find("permuted"), std::string::npos);
  EXPECT_FALSE(passes(t.value(metric("position", "final")), 1e9));
  auto hidden = flight();  // positions swapped, ids in order
  for (auto& f : hidden.run.frames) std::swap(f.position[2], f.position[9]);
  EXPECT_NE(hidden.sound(), "");
  EXPECT_GT(hidden.value(metric("position", "final")).value, 0.05);
}

TEST(GateThatNeverFails, AnotherUnitAndAnotherMassAreFound) {
  auto t = flight();
  for (auto& f : t.run.frames)
    for (auto& r : f.position) r = 1000.0 * r;
  EXPECT_NE(t.sound(), "");
  auto heavy = flight();
  heavy.run.frames.back().mass[0] *= 1.0 + 1e-9;
  EXPECT_NE(heavy.sound().find("mass"), std::string::npos);
}

TEST(GateThatNeverFails, AParticleThatIsLostIsFoundWhereverNoMetricLooksAtIt) {
  auto t = flight();
  for (auto& f : t.run.frames)
    if (f.time > 0.0)
      for (std::size_t i = 1; i < f.id.size(); ++i) {
        f.id[i] = -1;
        f.position[i] = f.velocity[i] = {not_a_number, not_a_number, not_a_number};
      }
  EXPECT_NE(t.sound().find("particle 1 is lost"), std::string::npos) << t.sound();
}

TEST(GateThatNeverFails, ABodysRowThatTellsOtherwiseThanItsParticlesIsFound) {
  auto t = flight();
  // a metric of the body alone would see this, and one of particles the other
  t.run.frames.back().bodies[0].position.z += 0.1;
  EXPECT_NE(t.sound().find("from the centre of its particles"), std::string::npos) << t.sound();
  // An engine that leaves these columns out hides nothing either.
  for (auto& f : t.run.frames) {
    f.body.clear();
    f.mass.clear();
  }
  EXPECT_NE(t.sound().find("from the centre of its particles"), std::string::npos) << t.sound();
  auto faster = flight();
  faster.run.frames.back().bodies[0].velocity.z *= 1.1;
  EXPECT_NE(faster.sound().find("moves otherwise than its particles"), std::string::npos) << faster.sound();
}

TEST(GateThatNeverFails, TheStartAloneIsNoRun) {
  const auto t = flight();
  auto only = metric("position", "max");
  only.window = {0.0, 1e-6};
  EXPECT_FALSE(passes(t.value(only), 1e9));
  EXPECT_NE(t.value(only).note.find("only the start"), std::string::npos);
}

TEST(Audit, PassesTheSoundRunsOfEveryKind) {
  EXPECT_EQ(flight().sound(), "");
  EXPECT_EQ(heat().sound(), "");
  auto still = test::block({}, 1.0, 4);  // a body at rest is not frozen
  EXPECT_EQ(Trial(still, "torque_free").sound(), "");
  auto s = test::block({}, 2.0, 20);  // nor is a pause between keyframes
  s.job.bodies[0].motion = Motion::prescribed;
  s.job.bodies[0].keyframes = {{0, {}, {}}, {0.5, {1, 0, 0}, {}}, {1.5, {1, 0, 0}, {}}, {2, {}, {}}};
  EXPECT_EQ(Trial(s, "keyframes").sound(), "");
}

}  // namespace
}  // namespace tripoint
