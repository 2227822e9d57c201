// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "scene/effect_rule.hpp"
#include "scene/sample.hpp"
#include "validation/case/preflight.hpp"

namespace tripoint::test {
namespace {

std::vector<Finding> findings(const std::string& text) {
  const auto c = read_text(text).value;
  const auto scene = scene_for(c, {});
  return preflight(c, scene, sample(scene));
}

/// The findings that contain a text: "error" or "warning", or "" for none.
std::string told(const std::string& text, const std::string& part) {
  for (const auto& f : findings(text))
    if (f.what.find(part) != std::string::npos) return f.error ? "error" : "warning";
  return "";
}

std::string scene_with(const std::string& bodies, const std::string& scene = "") {
  return "[scene]\nend_time = 1\nspacing = 0.1\n" + scene + "\n" + bodies;
}
std::string steel_box(const std::string& name, const std::string& min, const std::string& max, const std::string& more = "") {
  return "[[body]]\nname='" + name + "'\nmaterial='steel'\nshape={kind='box',min=" + min + ",max=" + max + "}\n" + more + "\n";
}

TEST(Preflight, FindsNothingInASoundScene) { EXPECT_TRUE(findings(six_lines).empty()); }

TEST(Preflight, FindsBodiesThatOverlap) {
  const auto a = steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]");
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.5,0,0]", "[1,0.5,0.5]")), "overlap"), "") << "they touch";
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.4,0,0]", "[1,0.5,0.5]")), "overlap"), "error");
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.47,0.03,0.02]", "[1,0.5,0.5]")), "overlap"), "") << "0.6 spacings apart";
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.43,0.03,0.02]", "[1,0.5,0.5]")), "overlap"), "error")
      << "0.3 spacings apart, on a lattice of its own";
}

TEST(Preflight, FindsOverlapAcrossAPeriodicSide) {
  const std::string domain = "min=[0,0,0]\nmax=[1,1,1]\nperiodic=['x']";
  EXPECT_EQ(
      told(scene_with(steel_box("a", "[0,0,0]", "[0.3,0.3,0.3]") + steel_box("b", "[0.7,0.03,0.03]", "[1.0,0.33,0.33]"), domain),
           "overlap"),
      "");
  const auto c =
      read_text(scene_with(steel_box("a", "[0,0,0]", "[0.3,0.3,0.3]") + steel_box("b", "[0.7,0,0]", "[1.0,0.3,0.3]"), domain))
          .value;
  auto scene = scene_for(c, {});
  auto state = sample(scene);
  for (std::size_t i = 0; i < state.size(); ++i)
    state.position[i].x += state.source[i] == 1 ? 0.03 : -0.03;  // 0.04 m apart across the periodic boundary
  const auto all = preflight(c, scene, state);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                          [](const Finding& f) { return f.error && f.what.find("overlap") != std::string::npos; }));
}

TEST(Preflight, WarnsOfRowsThatStandTooNear) {
  const std::string liquid = "[[body]]\nname='pool'\nmaterial='water'\nshape={kind='box',min=[0,0,0],max=[0.5,0.5,0.5]}\n";
  EXPECT_EQ(told(scene_with(liquid + steel_box("wall", "[-0.36,0,0]", "[0,0.5,0.5]", "motion='fixed'"), "gravity=[0,0,-9.81]"),
                 "of a spacing"),
            "warning")
      << "3.6 spacings thick: 0.6 from the first liquid row";
  EXPECT_EQ(told(scene_with(liquid + steel_box("wall", "[-0.3,0,0]", "[0,0.5,0.5]", "motion='fixed'"), "gravity=[0,0,-9.81]"),
                 "of a spacing"),
            "");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]", "motion='fixed'") +
                            steel_box("b", "[-0.36,0,0]", "[0,0.5,0.5]", "motion='fixed'")),
                 "of a spacing"),
            "")
      << "nothing presses";
}

TEST(Preflight, WarnsOfPiecesThatNothingKeepsApart) {
  const auto bar = [](const std::string& more, const std::string& scene = "") {
    return scene_with("[[material]]\nname='glue'\ndensity=1000\nyoung_modulus=1e6\npoisson_ratio=0.3\n" + more +
                          "[[body]]\nname='bar'\nmaterial='glue'\nshape={kind='box',min=[0,0,0],max=[0.5,0.5,0.5]}\n",
                      scene);
  };
  EXPECT_EQ(told(bar("fracture_stretch=1.1\n"), "pass through each other"), "warning");
  EXPECT_EQ(told(bar("fracture_stretch=1.1\nsound_speed=10\n"), "pass through each other"), "");
  EXPECT_EQ(told(bar("fracture_stretch=1.1\n", "contact='none'\n"), "pass through each other"), "");
  EXPECT_EQ(told(bar(""), "pass through each other"), "");
}

TEST(Preflight, FindsBodiesTooCoarseOrOfWrongMass) {
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.2]")), "2 particles across along z"), "warning");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.3]")), "across"), "");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.39,0.5,0.5]")), "its particles weigh"), "");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.34,0.34,0.34]")), "its particles weigh"), "warning");
}

TEST(Preflight, FindsATimeStepAboveTheBoundOfHeat) {
  // corrected: 0.075 (2.6 dx)^2 rho c/k = 0.075 * 0.0676 * 7850 * 439.8/53.3
  const double bound = 0.075 * 0.0676 * 7850.0 * 439.8 / 53.3;
  const auto text = [&](double dt) {
    return scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]", "motion='fixed'\ntemperature=300"),
                      "time_step=" + std::to_string(dt) + "\n");
  };
  auto longer = [&](double dt) {
    auto t = text(dt);
    t.replace(t.find("end_time = 1"), 12, "end_time = 1000");
    return t;
  };
  EXPECT_EQ(told(longer(1.01 * bound), "is above the bound of heat"), "error");
  EXPECT_EQ(told(longer(0.99 * bound), "is above the bound of heat"), "");
  std::string held = longer(1.01 * bound);
  held.replace(held.find("temperature=300"), 15, "temperature=300\ntemperature_held=true");
  EXPECT_EQ(told(held, "is above the bound of heat"), "");
}

TEST(Preflight, FindsATimeStepAboveTheBoundOfRotation) {
  const auto spin = steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]", "angular_velocity=[0,0,10]");
  EXPECT_EQ(told(scene_with(spin, "time_step=0.051"), "rotation of body \"a\""), "error");
  EXPECT_EQ(told(scene_with(spin, "time_step=0.049"), "rotation of body \"a\""), "");
  EXPECT_EQ(told("[case]\nexpect='diverges'\n" + scene_with(spin, "time_step=0.051"), "rotation of body \"a\""), "warning")
      << "a case may be meant to diverge";
}

TEST(Preflight, FindsKeyframesThatTurnTooFarOrJump) {
  const auto board = [](const std::string& first, const std::string& rotation) {
    return scene_with(steel_box(
        "a", "[0,0,0]", "[0.5,0.5,0.5]",
        "motion='prescribed'\nkeyframes=[{time=0,position=" + first + "},{time=1,position=[1,1,1],rotation=" + rotation + "}]"));
  };
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[0.1,0,0,0.99498743710662]"), "half a turn"), "");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[0,0,0,1]"), "half a turn"), "error");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[-0.1,0,0,0.99498743710662]"), "half a turn"), "error");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[1,0,0,0]"), "jumps"), "");
  EXPECT_EQ(told(board("[0.26,0.25,0.25]", "[1,0,0,0]"), "jumps"), "warning");
  EXPECT_EQ(told(board("[1,0.25,0.25]", "[1,0,0,0]"), "jumps"), "error");
  const std::string turned =
      "motion='prescribed'\nkeyframes=[{time=0,position=[0.25,0.25,0.25],rotation=[0.6,0.8,0,0]},{time=1,position=[1,1,1],"
      "rotation=[0.6,0.8,0,0]}]";
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]", turned)), "laid unturned"), "error");
}

TEST(CalledEffects, FollowFromWhatTheBodiesAre) {
  const auto names = [](const std::string& text) {
    std::string list;
    for (const auto& e : called_effects(scene_for(read_text(text).value, {}))) {
      EXPECT_NE(e.why, "");
      list += (list.empty() ? "" : " ") + e.name;
    }
    return list;
  };
  const auto one = [](const std::string& material, const std::string& more = "") {
    return "[scene]\nend_time=1\n[[body]]\nname='b'\nmaterial='" + material + "'\nshape={kind='box',min=[0,0,0],max=[1,1,1]}\n" +
           more;
  };
  EXPECT_EQ(names(one("steel")), "rigid");
  EXPECT_EQ(names(one("steel", "motion='fixed'\ntemperature=300")), "heat") << "what is held in place only conducts";
  EXPECT_EQ(names(one("steel", "temperature=300")), "rigid heat");
  EXPECT_EQ(names(one("water")), "fluid");
  EXPECT_EQ(names(one("water", "temperature=300")), "fluid heat");
  EXPECT_EQ(names(one("rubber")), "elastic");
  EXPECT_EQ(names(one("ice", "temperature=250\nmotion='fixed'")), "heat") << "nothing in the scene is above its melting point";
  EXPECT_EQ(
      names(one("ice",
                "temperature={kind='step',point=[0.5,0,0],normal=[1,0,0],behind=250,ahead=290}\nmotion='fixed'\nphase='rigid'")),
      "heat phase");
}

}  // namespace
}  // namespace tripoint::test
