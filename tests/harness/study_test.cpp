// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <ctime>

#include "assembly/plan.hpp"
#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/run/plan_runs.hpp"

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
  EXPECT_THROW((void)read_flight_case(
                   folder, "[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.05]\nsupport_ratios = [2.0]\n"),
               InputError);
  EXPECT_THROW(
      (void)read_flight_case(
          folder, "[[study]]\naxis = \"support_ratio\"\nlevels = [2.0, 3.0]\nsupport_ratios = [2.0, 3.0]\n"),
      InputError);
}

/// The plan of our own engine.
EnginePlan our_plan(const Case& value) {
  EngineEntry ours;
  ours.name = "tripoint";
  Selection only;
  only.engines = {"tripoint"};
  return plan_runs(value, {ours}, only).at(0);
}

TEST(Engines, OurSolverIsNotRequiredWhereAllEnginesGetALawOfContactThatItDoesNotHave) {
  const TestFolder folder;
  const auto required = [&](const std::string& settings) {
    return our_plan(read_flight_case(folder, "[engines.all]\nsettings = { " + settings + " }\n")).required;
  };
  EXPECT_FALSE(required("friction = 0.3"));
  EXPECT_FALSE(required("restitution = 0.5"));
  EXPECT_TRUE(required("friction = 0.0"));
  EXPECT_TRUE(required("friction = 0.0, restitution = 1.0"));
}

TEST(Studies, OfANumberThatAnEngineHasNotAreItsOwnRunAlone) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, "[[study]]\naxis = \"walkers\"\nlevels = [10, 100]\n");
  Selection only;
  only.engines = {"other"};
  const auto plan = [&](const std::string& setting) {
    EngineEntry other;
    other.name = "other";
    other.settings = {{setting, "a number"}};
    return plan_runs(value, {other}, only).at(0).runs;
  };
  EXPECT_EQ(plan("walkers").size(), 3u);
  const auto runs = plan("time_step");
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].levels.at(value.studies[0].axes), 100.0);
}

TEST(Studies, ShareTheRunsThatAreTheSame) {
  const TestFolder folder;
  const auto value = read_flight_case(folder, R"(
[[study]]
axis = "spacing"
levels = [0.1, 0.05]
[[study]]
axis = "spacing"
levels = [0.05000000000001, 0.025]
[[study]]
axis = "spacing"
levels = [0.1, 0.05]
jitter = 0.1
seeds = 2
[[study]]
axis = "spacing"
levels = [0.05, 0.025]
jitter = 0.1
seeds = 3
)");
  std::string planned;
  for (const auto& run : our_plan(value).runs) planned += run.label + " of " + run.group + "\n";
  EXPECT_EQ(planned,
            "corrected of corrected\n"  // 0.1 is the case's own
            "corrected-spacing=0.05 of corrected-spacing=0.05\n"
            "corrected-spacing=0.025 of corrected-spacing=0.025\n"
            "corrected-spacing=0.1-jitter=0.1 of corrected-spacing=0.1-jitter=0.1\n"
            "corrected-spacing=0.1-jitter=0.1-seed2 of corrected-spacing=0.1-jitter=0.1\n"
            "corrected-spacing=0.05-jitter=0.1 of corrected-spacing=0.05-jitter=0.1\n"
            "corrected-spacing=0.05-jitter=0.1-seed2 of corrected-spacing=0.05-jitter=0.1\n"
            "corrected-spacing=0.05-jitter=0.1-seed3 of corrected-spacing=0.05-jitter=0.1\n"
            "corrected-spacing=0.025-jitter=0.1 of corrected-spacing=0.025-jitter=0.1\n"
            "corrected-spacing=0.025-jitter=0.1-seed2 of corrected-spacing=0.025-jitter=0.1\n"
            "corrected-spacing=0.025-jitter=0.1-seed3 of corrected-spacing=0.025-jitter=0.1\n");
}

TEST(Studies, OfAThousandSeedsArePlannedAtOnce) {
  const TestFolder folder;
  const auto value = read_flight_case(
      folder, "[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.05]\njitter = 0.1\nseeds = 1000\n");
  const auto start = std::clock();
  EXPECT_EQ(our_plan(value).runs.size(), 2001U);
  // Ten seconds where each is compared with all
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
}

TEST(Studies, ThatAskForMoreRunsThanCanBePlannedAreRefusedWithTheirLine) {
  const TestFolder folder;
  const auto study = [](int number, const std::string& seeds) {
    return "[[study]]\naxis = \"spacing\"\nlevels = [0.1, 0.09, 0.08, 0.07, 0.06]\njitter = 0.0" +
           std::to_string(number) + "\nseeds = " + seeds + "\n";
  };
  EXPECT_EQ(our_plan(read_flight_case(folder, study(1, "1000") + study(2, "999"))).runs.size(), 9996U);
  const auto value = read_flight_case(folder, study(1, "1000") + study(2, "1000"));
  try {
    static_cast<void>(our_plan(value));
    FAIL() << "10001 runs";
  } catch (const InputError& e) {
    EXPECT_EQ(e.place().line, value.studies.at(1).place.line);
    EXPECT_GT(e.place().line, 0);
    EXPECT_NE(std::string(e.what()).find("flight.toml"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("more than the 10000 that can be planned"), std::string::npos)
        << e.what();
  }
}

TEST(Studies, OfMoreThanAHundredLevelsAreRefused) {
  const TestFolder folder;
  const auto study = [](int levels) {
    std::string list;
    for (int k = 0; k < levels; ++k) list += std::to_string(0.3 - 0.001 * k) + ", ";
    return "[[study]]\naxis = \"spacing\"\nlevels = [" + list + "]\n";
  };
  EXPECT_EQ(read_flight_case(folder, study(100)).studies.at(0).levels.size(), 100U);
  try {
    static_cast<void>(read_flight_case(folder, study(101)));
    FAIL() << "101 levels";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("101 levels: write at most 100"), std::string::npos) << e.what();
    EXPECT_GT(e.place().line, 0);
  }
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
