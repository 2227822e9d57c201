// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/harness/plan_runs.hpp"

namespace tripoint {
namespace {

const std::string together = R"(
[[study]]
axis = "spacing"
levels = [0.1, 0.05]
[[study]]
axis = "spacing"
levels = [0.1, 0.05]
support_ratios = [2.0, 2.8]
time_steps = [0.01, 0.005]
)";

TEST(Studies, WhatIsRefinedTogetherIsALadderOfItsOwn) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, together);
  EngineEntry ours;
  ours.name = "tripoint";
  Selection only;
  only.engines = {"tripoint"};
  const auto plan = plan_runs(value, {ours}, only).at(0);
  int alone = 0, joint = 0;
  for (const auto& run : plan.runs) {
    alone += run.levels.count({Axis::spacing}) > 0;
    if (const auto at = run.levels.find({Axis::spacing, true, true}); at != run.levels.end()) {
      ++joint;
      const auto scene = scene_of(value, run);
      EXPECT_EQ(scene.spacing, at->second);
      EXPECT_EQ(scene.support_ratio, at->second == 0.1 ? 2.0 : 2.8);
      EXPECT_EQ(scene.time_step.value(), at->second == 0.1 ? 0.01 : 0.005);
    }
  }
  EXPECT_EQ(alone, 2);
  EXPECT_EQ(joint, 2);
}

TEST(Studies, WithAnotherNumberOfCompanionsThanLevelsAreRefused) {
  const TestFolder folder;
  EXPECT_THROW((void)read_flight_case(folder, "[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.05]\nsupport_ratios = [2.0]\n"),
               InputError);
  EXPECT_THROW(
      (void)read_flight_case(folder, "[[study]]\naxis = \"support_ratio\"\nlevels = [2.0, 3.0]\nsupport_ratios = [2.0, 3.0]\n"),
      InputError);
}

TEST(Studies, AJointLadderIsFittedOverItsSpacing) {
  auto r = study_of({1.6e-1, 4.0e-2, 1.0e-2, 2.5e-3});
  for (auto& run : engine(r).runs) run.levels = {{{Axis::spacing, false, true}, run.levels.begin()->second}};
  r.cases[0].studies[0].axes = {Axis::spacing, false, true};
  judge(r);
  ASSERT_EQ(engine(r).order.size(), 1u);
  EXPECT_NEAR(engine(r).order[0].order.value, 2.0, 1e-9);  // an exact power
}

}  // namespace
}  // namespace tripoint
