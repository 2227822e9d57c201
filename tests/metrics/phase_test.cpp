// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "metrics/frames.hpp"
#include "references/melting.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Still;

TEST(PhaseMetrics, CountAndWeighTheStatedPhase) {
  Still f(test::blocks());
  auto& last = f.run.frames.back();
  for (std::size_t i = 0; i < 5; ++i) last.phase[i] = 0;
  last.phase[5] = 2;
  const auto of = [](const char* phase, double value) {
    return Settings{{"phase", std::string(phase)}, {"value", value}};
  };
  EXPECT_EQ(f.stated(metric("phase_count", "final"), of("liquid", 8.0)), 5.0);
  EXPECT_EQ(f.stated(metric("phase_count", "final", "left"), of("elastic", 58.0)), 0.0);
  EXPECT_EQ(f.stated(metric("phase_count", "final"), of("solid", 123.0)), 0.0);
  // 1 kg a particle
  EXPECT_NEAR(f.stated(metric("mass_of_phase", "final", "left"), of("liquid", 4.0)), 1.0, 1e-12);
  last.id[0] = -1;
  EXPECT_NEAR(f.stated(metric("mass_of_phase", "final", "left"), of("liquid", 4.0)), 0.0, 1e-12);
  EXPECT_THROW((void)f.stated(metric("phase_count", "final"), of("gas", 0.0)), InputError);
}

TEST(PhaseMetrics, WeighWhatIsInABoxOrOutsideIt) {
  Still f(test::blocks());
  const Settings box{
      {"min", std::vector<double>{0, 0, 0}}, {"max", std::vector<double>{0.4, 0.4, 0.2}}, {"value", 0.0}};
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final"), box), 32.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final", "left"), box), 0.0, 1e-12);
  auto rest = box;
  rest["outside"] = true;
  rest["phase"] = std::string("liquid");
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final"), rest), 8.0, 1e-12);
  EXPECT_TRUE(std::isnan(f.stated(metric("mass_in_region", "final"), {{"value", 0.0}})));
}

TEST(PhaseMetrics, KnowMatterInABoxByItsImages) {
  auto scene = test::blocks();
  scene.job.scene.min = {-10, -10, -10};
  scene.job.scene.max = {10, 10, 10};
  scene.job.scene.periodic = {true, false, false};
  Still f(std::move(scene));
  const Settings box{
      {"min", std::vector<double>{0, 0, 0}}, {"max", std::vector<double>{0.4, 0.4, 0.2}}, {"value", 32.0}};
  for (auto& r : f.run.frames.back().position) r.x += 40.0;
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final"), box), 0.0, 1e-12);
  for (auto& r : f.run.frames.back().position) r.y += 40.0;
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final"), box), -32.0, 1e-12);
}

TEST(PhaseMetrics, LetABoxMoveAndTurnWithABody) {
  Still f(test::blocks());
  auto& last = f.run.frames.back();
  const Quaternion turn = from_rotation_vector({0, 0.5 * std::numbers::pi, 0});
  last.bodies[0].position += Vec3{3, 0, 1};
  last.bodies[0].orientation = turn;
  for (std::size_t i = 0; i < last.position.size(); ++i)
    if (f.s.initial.source[i] == 0)
      last.position[i] = last.bodies[0].position +
                         rotate(turn, f.s.initial.position[i] - f.s.job.bodies[0].properties.centre);
  Settings lower{{"min", std::vector<double>{-0.4, 0, 0}},
                 {"max", std::vector<double>{0, 0.4, 0.2}},
                 {"value", 32.0},
                 {"follows", true}};
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final", "left"), lower), 0.0, 1e-12);
  lower["follows"] = false;
  EXPECT_NEAR(f.stated(metric("mass_in_region", "final", "left"), lower), -32.0, 1e-12);
}

TEST(PhaseMetrics, CountOnlyWhatTurnsBack) {
  Still f(test::blocks());
  EXPECT_EQ(f.stated(metric("toggles", "final")), 0.0);
  for (std::size_t n = 2; n < 5; ++n) f.run.frames[n].phase[3] = 0;  // melts once
  EXPECT_EQ(f.stated(metric("toggles", "final")), 0.0);
  f.run.frames[3].phase[3] = 2;  // freezes to another solid, and melts again
  EXPECT_EQ(f.stated(metric("toggles", "final")), 2.0);
  EXPECT_EQ(f.stated(metric("toggles", "final", "right")), 0.0);
}

TEST(PhaseMetrics, FindTheFrontFinerThanAParticle) {
  Still f(test::stefan_bar({}));
  const auto truth = make_reference(test::function("stefan"), f.s.job, f.s.initial);
  for (auto& frame : f.run.frames) {
    frame.liquid_fraction = truth->at(frame.time).liquid_fraction;
    frame.phase = truth->at(frame.time).phase;
  }
  EXPECT_NEAR(f.of(metric("front_position", "max"), "stefan").value, 0.0, 1e-12);
  EXPECT_NEAR(f.of(metric("phase_count", "max"), "stefan").value, 0.0, 1e-12);
  // Nothing has melted at the start
  EXPECT_TRUE(std::isnan(f.of(metric("front_ratio", "max"), "stefan").value));
  auto& last = f.run.frames.back().liquid_fraction;
  for (std::size_t i = 4 * 20; i < 4 * 22; ++i) last[i] += 0.25;  // two layers, a quarter each
  const double X = *truth->number_at("front_position", 20.0);
  EXPECT_NEAR(f.of(metric("front_position", "final"), "stefan").value, 0.5e-3, 1e-12);
  EXPECT_NEAR(f.of(metric("front_ratio", "Linf"), "stefan").value, 0.5e-3 / X, 1e-9);
}

TEST(PhaseMetrics, FindTheFrontByPhasesWhereThereIsNoFraction) {
  Still f(test::stefan_bar({}));
  const auto truth = make_reference(test::function("stefan"), f.s.job, f.s.initial);
  for (auto& frame : f.run.frames) frame.phase = truth->at(frame.time).phase;
  EXPECT_NEAR(f.of(metric("front_position", "final"), "stefan").value, 0.0, 1e-3);  // one layer
}

TEST(PhaseMetrics, FollowAHysteresisLoop) {
  Still f(test::heated_block());
  const auto truth = make_reference(test::function("hysteresis"), f.s.job, f.s.initial);
  for (auto& frame : f.run.frames) frame.phase = truth->at(frame.time).phase;
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 0.0);
  EXPECT_EQ(f.stated(metric("toggles", "final"), {{"value", 1.0}}), 0.0);  // out and back
  EXPECT_EQ(f.stated(metric("toggles", "final")), 1.0);
  EXPECT_EQ(f.of(metric("toggles", "final"), "hysteresis").value, 0.0);  // as the loop itself
  for (auto& frame : f.run.frames) frame.phase[0] = 1;
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 1.0);
}

}  // namespace
}  // namespace tripoint
