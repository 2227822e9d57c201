// SPDX-License-Identifier: BSD-3-Clause
// A metric measures what its name says: the liquid and not its tank, the frame that its norm needs, the
// number that a case states.
#include <gtest/gtest.h>

#include <cmath>

#include "core/not_a_number.hpp"
#include "metrics/frames.hpp"
#include "references/liquids.hpp"
#include "references/measured.hpp"
#include "references/melting.hpp"
#include "validation/metrics/metric.hpp"

namespace tripoint {
namespace {

using test::metric;
using test::Still;

/// A column of liquid, 0.4 m along x, in a tank whose end wall stands from 2 m to 2.3 m and whose fixed floor
/// is liquid's material.
Still column_in_a_tank() {
  test::Prepared s;
  s.job.scene.spacing = 0.1;
  test::add_matter(s, "column", Phase::liquid, {{4, 4, 4}, 0.1, {}, 1.0}, {}, 1000.0);
  test::add_matter(s, "wall", Phase::rigid, {{3, 4, 4}, 0.1, {2, 0, 0}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
  test::add_matter(s, "held liquid", Phase::liquid, {{3, 4, 4}, 0.1, {4, 0, 0}, 1.0}, {}, 1000.0, 0.0,
                   Motion::fixed);
  test::set_times(s, 1.0, 4);
  return Still(s);
}

TEST(RightMatter, OfAFrontIsTheLiquidWhereNoBodyIsNamed) {
  const Still f = column_in_a_tank();
  const test::DataFile file(
      test::sealed("# source: none\n# unit time: 1 s\n# unit front: 1 m\n# uncertainty front: 1 "
                   "%\ntime,front\n0,0.3\n0.5,0.35\n1,0.4\n"));
  const auto truth = make_reference(test::experiment(file), f.s.job, f.s.initial);
  const auto lead = [&](const char* body) {
    return evaluate(metric("front_lead", "final", body), f.s.job, f.s.initial, f.run, *truth);
  };
  EXPECT_NEAR(lead("").value, 0.1, 1e-12) << "at 0 s, and the first and last frames count";
  EXPECT_NEAR(lead("column").value, 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(lead("wall").value));
  EXPECT_NE(lead("wall").note.find("`wall` has no liquid"), std::string::npos) << lead("wall").note;
}

TEST(RightMatter, OfAHalfLengthIsTheLiquid) {
  const Still f = column_in_a_tank();
  EXPECT_NEAR(f.stated(metric("half_length", "final"), {{"axis", std::string("x")}, {"value", 0.2}}), 0.0,
              1e-12);
  EXPECT_NEAR(f.stated(metric("half_length", "final", "wall"), {{"axis", std::string("x")}, {"value", 0.2}}),
              -0.05, 1e-12);
}

TEST(RightMatter, OfAnOverlapIsNotThatOfTwoWalls) {
  test::Prepared s;
  s.job.scene.spacing = 0.1;
  test::add_matter(s, "floor", Phase::rigid, {{4, 4, 4}, 0.1, {}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
  test::add_matter(s, "wall", Phase::rigid, {{4, 4, 4}, 0.1, {0.35, 0, 0}, 1.0}, {}, 1000.0, 0.0,
                   Motion::fixed);
  test::set_times(s, 1.0, 4);
  Still f(s);
  EXPECT_NEAR(f.stated(metric("overlap", "max"), {{"value", 0.0}}), 0.0, 1e-12);
  f.s.job.bodies[1].motion = Motion::free;
  EXPECT_NEAR(f.stated(metric("overlap", "max"), {{"value", 0.0}}), 0.5, 1e-12);
}

TEST(RightMatter, OfASumIsTheNamedBody) {
  Still f = column_in_a_tank();
  for (auto& frame : f.run.frames)
    for (auto& v : frame.velocity) v = {0, 0, 2};
  EXPECT_NEAR(f.stated(metric("mass", "final", "column"), {{"value", 64.0}}), 0.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("momentum", "final", "column"), {{"value", 128.0}}), 0.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("momentum", "final", "column"), {{"axis", std::string("x")}, {"value", 1.0}}),
              -1.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("energy", "final", "column"), {{"value", 100.0}}), 28.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("ledger.kinetic", "final", "column"), {{"value", 100.0}}), 28.0, 1e-12);
  f.run.frames.back().energy["elastic"] = 1.0;
  EXPECT_TRUE(std::isnan(f.stated(metric("ledger.elastic", "final", "column"), {{"value", 1.0}})))
      << "it is of the whole scene";
  EXPECT_NEAR(f.stated(metric("ledger.elastic", "final"), {{"value", 1.0}}), 0.0, 1e-12);
}

// --- frames that a norm needs

TEST(RightFrames, OfAFinalValueAreTheLastAlone) {
  Still f(test::stefan_bar({}));
  const auto truth = make_reference(test::function("stefan"), f.s.job, f.s.initial);
  for (auto& frame : f.run.frames) {
    frame.liquid_fraction = truth->at(frame.time).liquid_fraction;
    frame.phase = truth->at(frame.time).phase;
  }
  EXPECT_NEAR(f.of(metric("front_ratio", "final"), "stefan").value, 0.0, 1e-9)
      << "nothing has melted at the start";
  f.run.frames.back().liquid_fraction.clear();
  f.run.frames.back().phase.clear();
  EXPECT_TRUE(std::isnan(f.of(metric("front_ratio", "final"), "stefan").value));
}

TEST(RightFrames, OfAChangeSinceTheStartIsTheFirstAlsoBesideAStatedValue) {
  Still f(test::blocks());
  f.shift(f.run.frames[2], 0, {0.3, 0, 0});
  EXPECT_NEAR(f.stated(metric("centre", "drift", "left"), {{"axis", std::string("x")}, {"value", 7.0}}), 0.3,
              1e-12);
  EXPECT_NEAR(f.stated(metric("separation", "drift", "left"), {{"other", std::string("right")}}), 0.3, 1e-12);
}

// --- events at the start

/// A block that is heated above its melting point at 0 s, and is liquid from then on.
Still melted_at_the_start() {
  auto s = test::heated_block();
  s.job.scene.events.resize(1);
  s.job.scene.events[0].time = 0.0;
  Still f(s);
  for (std::size_t n = 1; n < f.run.frames.size(); ++n) f.run.frames[n].phase.assign(s.initial.size(), 0);
  return f;
}

TEST(RightStart, OfAnEventAtZeroMayShowEitherPhase) {
  Still f = melted_at_the_start();
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 0.0)
      << "the first frame is before the event";
  f.run.frames.front().phase.assign(f.s.initial.size(), 0);
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 0.0) << "the first frame is after it";
  f.run.frames[1].phase[3] = 1;
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 1.0);
  f.run.frames[1].phase[3] = 0;
  f.run.frames[0].phase[3] = 2;
  EXPECT_EQ(f.of(metric("phase_count", "max"), "hysteresis").value, 1.0) << "rigid is neither";
}

TEST(RightStart, OfAMergeAtZeroIsAnEvent) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames) frame.bodies[1].position.x = not_a_number;
  EXPECT_NEAR(f.stated(metric("event_time", "max"), {{"value", 0.0}}), 0.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("event_time", "max"), {{"value", 0.25}}), 0.25, 1e-12);
}

// --- numbers that a case states

TEST(StatedNumbers, OfABodyAreASizeOrAComponent) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames) {
    auto& b = frame.bodies[0];
    b.force = {3, 0, -4};
    b.torque = {0, 2, 0};
    b.velocity = {0, 0, -2};
    b.angular_velocity = {0, -5, 0};
    b.orientation = from_rotation_vector({0, 0, 0.25});
  }
  const auto of = [&](const char* quantity, double number, const char* axis = "") {
    Settings args{{"value", number}};
    if (*axis != '\0') args["axis"] = std::string(axis);
    return f.stated(metric(quantity, "mean", "left"), args);
  };
  EXPECT_NEAR(of("force", 4.5), 0.5, 1e-12);
  EXPECT_NEAR(of("force", -4.5, "z"), 0.5, 1e-12);
  EXPECT_NEAR(of("torque", 2.0), 0.0, 1e-12);
  EXPECT_NEAR(of("velocity", 0.0), 2.0, 1e-12);
  EXPECT_NEAR(of("velocity", 0.0, "z"), -2.0, 1e-12);
  EXPECT_NEAR(of("angular_velocity", -4.0, "y"), -1.0, 1e-12);
  EXPECT_NEAR(of("orientation", 0.2), 0.05, 1e-12);
  EXPECT_NEAR(of("position", -0.2, "x"), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(of("position", 0.0))) << "a place has no size";
  EXPECT_TRUE(std::isnan(f.stated(metric("force", "mean"), {{"value", 1.0}}))) << "of which body?";
  EXPECT_TRUE(std::isnan(f.stated(metric("force", "mean", "left"), {})));
  for (auto& frame : f.run.frames) frame.bodies[0].force = {not_a_number, not_a_number, not_a_number};
  const auto none = f.of(metric("force", "mean", "left"), "stated", {{"value", 0.0}});
  EXPECT_TRUE(std::isnan(none.value)) << "what an engine does not show is not 0";
  EXPECT_EQ(none.note, "the engine shows no force on the body");
}

TEST(StatedNumbers, OfParticlesAreOneForAll) {
  Still f(test::blocks());
  for (auto& frame : f.run.frames) frame.temperature.assign(f.s.initial.size(), 301.0);
  f.run.frames.back().temperature[2] = 305.0;
  EXPECT_NEAR(f.stated(metric("temperature", "Linf"), {{"value", 300.0}}), 5.0, 1e-12);
  EXPECT_NEAR(f.stated(metric("temperature", "L1", "right"), {{"value", 300.0}}), 1.0, 1e-12);
}

}  // namespace
}  // namespace tripoint
