// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/shape_match.hpp"

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
std::string steel_box(const std::string& name, const std::string& min, const std::string& max,
                      const std::string& more = "") {
  return "[[body]]\nname='" + name + "'\nmaterial='steel'\nshape={kind='box',min=" + min + ",max=" + max +
         "}\n" + more + "\n";
}

TEST(Preflight, FindsNothingInASoundScene) { EXPECT_TRUE(findings(six_lines).empty()); }

TEST(Preflight, FindsBodiesThatOverlap) {
  const auto a = steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]");
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.5,0,0]", "[1,0.5,0.5]")), "overlap"), "") << "they touch";
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.4,0,0]", "[1,0.5,0.5]")), "overlap"), "error");
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.47,0.03,0.02]", "[1,0.5,0.5]")), "share space"), "error");
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.45,0,0]", "[0.95,0.5,0.5]")), "share space up to 0.05 m"),
            "error")
      << "half a lattice";
  EXPECT_EQ(told(scene_with(a + steel_box("b", "[0.49999999999999994,0,0]", "[1,0.5,0.5]")), "overlap"), "")
      << "round-off";
}

std::string body(const std::string& name, const std::string& shape) {
  return "[[body]]\nname='" + name + "'\nmaterial='steel'\nshape=" + shape + "\n";
}

/// Each pair of kinds twice: faces that touch, and the second shape 0.05 m farther in.
TEST(Preflight, FindsTheOverlapOfEveryPairOfKinds) {
  const Folder folder;
  static_cast<void>(folder.write("cube.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                                 "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"));
  // All end at z = 1 between 0 and 1, or begin at z = `low` there.
  const std::string below[]{
      "{kind='box',min=[0,0,0],max=[1,1,1]}",
      "{kind='sphere',centre=[0.5,0.5,0.5],radius=0.5}",
      "{kind='cylinder',base=[0.5,0.5,0],axis=[0,0,1],length=1,radius=0.5}",
      "{kind='difference',from={kind='box',min=[0,0,0],max=[1,1,2]},minus={kind='half_space',point=[0,0,1],"
      "normal=[0,0,-1]}}",
      "{kind='union',of=[{kind='box',min=[0,0,0],max=[1,1,0.5]},{kind='box',min=[0,0,0.5],max=[1,1,1]}]}",
      "{kind='mesh',file='cube.obj'}"};
  const auto above = [](int kind, double low) {
    const auto z = [&](double height) { return std::to_string(low + height); };
    const std::string shapes[]{
        "{kind='box',min=[0,0," + z(0) + "],max=[1,1," + z(1) + "]}",
        "{kind='sphere',centre=[0.5,0.5," + z(0.5) + "],radius=0.5}",
        "{kind='cylinder',base=[0,0.5," + z(0.5) + "],axis=[1,0,0],length=1,radius=0.5}",
        "{kind='difference',from={kind='box',min=[0,0,0],max=[1,1," + z(1) +
            "]},minus={kind='box',min=[-1,-1,-1],max=[2,2," + z(0) + "]}}",
        "{kind='union',of=[{kind='box',min=[0,0," + z(0) + "],max=[1,1," + z(0.5) +
            "]},{kind='sphere',centre=[0.5,0.5," + z(0.5) + "],radius=0.5}]}",
        "{kind='half_space',point=[0,0," + z(0) + "],normal=[0,0,-1]}"};
    return shapes[kind];
  };
  const auto told_of = [&](const std::string& a, const std::string& b) {
    const auto file = folder.write(
        "case.toml", scene_with(body("a", a) + body("b", b), "min=[-0.5,-0.5,-0.5]\nmax=[1.5,1.5,2.5]\n"));
    const auto c = read_case(file).value;
    const auto scene = scene_for(c, {});
    std::string text;
    for (const auto& f : preflight(c, scene, sample(scene)))
      if (f.error) text += f.what + "\n";
    return text;
  };
  for (const auto& a : below)
    for (int kind = 0; kind < 6; ++kind) {
      EXPECT_EQ(told_of(a, above(kind, 1.0)).find("share space"), std::string::npos)
          << a << " touches " << above(kind, 1.0);
      EXPECT_NE(told_of(a, above(kind, 0.95)).find("share space"), std::string::npos)
          << a << " meets " << above(kind, 0.95);
    }
}

/// A ball that is cut out of a pool shares no room with it; off the pool's lattice its particles stand too
/// near, and a shift helps.
TEST(Preflight, NamesTheShiftThatPutsACutOutBodyOnTheLattice) {
  const auto scene = [](double z) {
    const std::string ball = "{kind='sphere',centre=[0.6,0.6," + std::to_string(z) + "],radius=0.3}";
    return scene_with(
        "[[body]]\nname='pool'\nmaterial='water'\nshape={kind='difference',from={kind='box',min=[0,0,0],max=["
        "1.2,1.2,"
        "1]},minus=" +
            ball + "}\n" + body("ball", ball),
        "gravity=[0,0,-9.81]");
  };
  EXPECT_EQ(told(scene(0.65), "overlap"), "") << "half a spacing off: accepted";
  EXPECT_EQ(told(scene(0.65), "cut out for it alike, by (0, 0, -0.05) m"), "warning");
  EXPECT_EQ(told(scene(0.67), "do not overlap"), "error");
  EXPECT_EQ(told(scene(0.67), "cut out for it alike, by (0, 0, 0.03) m"), "error");
  EXPECT_EQ(told(scene(0.67), "share space"), "");
  EXPECT_EQ(told(scene(0.70), "overlap"), "") << "moved as it says";
}

std::string tank(const std::string& wall) {
  return "[[body]]\nname='pool'\nmaterial='water'\nshape={kind='box',min=[0,0,0],max=[0.5,0.5,0.5]}\n"
         "[[body]]\nname='tank'\nmaterial='steel'\nmotion='fixed'\nshape={kind='difference',from={kind='box',"
         "min=[-" +
         wall + ",-" + wall + ",-" + wall +
         "],max=[0.8,0.8,0.8]},minus={kind='box',min=[0,0,0],max=[0.5,0.5,9]}}\n";
}

TEST(Preflight, WarnsOfWallsThinnerThanTheSupport) {
  EXPECT_EQ(told(scene_with(tank("0.1"), "gravity=[0,0,-9.81]"), "1 layer of particles thick"), "warning");
  EXPECT_EQ(told(scene_with(tank("0.2"), "gravity=[0,0,-9.81]"), "make them 3 layers, 0.3 m"), "warning");
  EXPECT_EQ(told(scene_with(tank("0.3"), "gravity=[0,0,-9.81]"), "layer"), "");
}

TEST(Preflight, WarnsOfAWallThatTheSpacingDoesNotDivide) {
  EXPECT_EQ(told(scene_with(tank("0.36"), "gravity=[0,0,-9.81]"), "does not divide the 0.36 m"), "warning");
  EXPECT_EQ(told(scene_with(tank("0.3"), "gravity=[0,0,-9.81]"), "does not divide"), "");
  const auto dry = steel_box("floor", "[0,0,-0.36]", "[1,1,0]", "motion='fixed'");
  EXPECT_EQ(told(scene_with(dry + steel_box("block", "[0,0,0]", "[0.5,0.5,0.5]")), "does not divide"), "");
}

TEST(Preflight, WarnsOfALiquidThatItsOwnWeightPressesTogether) {
  const auto with = [](const std::string& speed) {
    return scene_with(tank("0.3"), "gravity=[0,0,-9.81]\n[[material]]\nname='water'\nsound_speed=" + speed);
  };
  EXPECT_EQ(told(with("5"), "presses it together by 20 %"), "warning");
  EXPECT_EQ(told(with("31"), "presses it together"), "");
}

/// The first of the notes on what a run will not show; "" for none.
std::string foretold(const std::string& text) {
  const auto notes = foreseen(scene_for(read_text(text).value, {}));
  return notes.empty() ? "" : notes.front().what;
}

TEST(Preflight, ForetellsASlopeWithoutFriction) {
  const auto block = steel_box("block", "[0,0,1]", "[0.5,0.5,1.5]");
  const auto ramp = [](const std::string& rotation) {
    return steel_box("ramp", "[-1,-1,-0.3]", "[1,1,0]", "motion='fixed'\nrotation=" + rotation);
  };
  EXPECT_NE(foretold(scene_with(block + ramp("[0.8,0,0.6,0]"), "gravity=[0,0,-9.81]")).find("slopes"),
            std::string::npos);
  EXPECT_EQ(foretold(scene_with(block + ramp("[0.8,0,0,0.6]"), "gravity=[0,0,-9.81]")), "")
      << "its faces lie level";
}

TEST(Preflight, ForetellsHeatThatStaysWhereItIs) {
  const auto bar = [](const std::string& conductivity) {
    return "[[material]]\nname='stuff'\ndensity=1000\nheat_capacity=1000\nconductivity=" + conductivity +
           "\n[[body]]\nname='bar'\nmaterial='stuff'\nshape={kind='box',min=[0,0,0],max=[1,1,1]}\n"
           "temperature={kind='step',point=[0.5,0,0],normal=[1,0,0],behind=300,ahead=400}\n";
  };
  EXPECT_NE(foretold(scene_with(bar("1"))).find("heat spreads 0.002 m"), std::string::npos);
  EXPECT_EQ(foretold(scene_with(bar("1e5"))), "");
}

/// 1000 particles, and steps of 10 ms at a sound speed of 10 m/s.
TEST(Preflight, ForetellsTheCostWithinAFactorOfThree) {
  const auto c =
      read_text(scene_with("[[material]]\nname='water'\nsound_speed=10\n[[body]]\nname='pool'\n"
                           "material='water'\nphase='liquid'\nshape={kind='box',min=[0,0,0],max=[1,1,1]}\n"))
          .value;
  const auto scene = scene_for(c, {});
  const auto seconds = cpu_seconds(scene, sample(scene));
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(*seconds, 1000 * 100 * 0.6e-6, 1e-12);
}

/// A drop of wax freezes: 0.5 dx/c, c^2 = E/rho where Poisson's ratio is 0.
TEST(Preflight, ForetellsTheCostOfMatterThatFreezesElastic) {
  const auto c =
      read_text(scene_with("[[material]]\nname='m'\nsound_speed=10\ndensity=1000\nyoung_modulus=1e9\n"
                           "poisson_ratio=0\nconductivity=1\nheat_capacity=1000\nt_melt=300\n"
                           "[[body]]\nname='hot'\nmaterial='m'\ntemperature=310\n"
                           "shape={kind='box',min=[0,0,0],max=[1,1,1]}\n"
                           "[[body]]\nname='cold'\nmaterial='m'\nmotion='fixed'\ntemperature=290\n"
                           "shape={kind='box',min=[0,0,-1],max=[1,1,0]}\n"))
          .value;
  const auto scene = scene_for(c, {});
  const auto seconds = cpu_seconds(scene, sample(scene));
  ASSERT_TRUE(seconds);
  EXPECT_NEAR(*seconds, 2000 * 1000.0 / (0.5 * 0.1) * 0.6e-6, 1e-6);
}

TEST(Preflight, FindsOverlapAcrossAPeriodicSide) {
  const std::string domain = "min=[0,0,0]\nmax=[1,1,1]\nperiodic=['x']";
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.3,0.3,0.3]") +
                                steel_box("b", "[0.7,0.03,0.03]", "[1.0,0.33,0.33]"),
                            domain),
                 "overlap"),
            "");
  const auto c = read_text(scene_with(steel_box("a", "[0,0,0]", "[0.3,0.3,0.3]") +
                                          steel_box("b", "[0.7,0,0]", "[1.0,0.3,0.3]"),
                                      domain))
                     .value;
  auto scene = scene_for(c, {});
  auto state = sample(scene);
  for (std::size_t i = 0; i < state.size(); ++i)
    state.position[i].x += state.source[i] == 1 ? 0.03 : -0.03;  // 0.04 m apart across the periodic boundary
  const auto all = preflight(c, scene, state);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Finding& f) {
    return f.error && f.what.find("overlap") != std::string::npos;
  }));
}

TEST(Preflight, WarnsOfRowsThatStandTooNear) {
  const std::string liquid =
      "[[body]]\nname='pool'\nmaterial='water'\nshape={kind='box',min=[0,0,0],max=[0.5,0.5,0.5]}\n";
  EXPECT_EQ(told(scene_with(liquid + steel_box("wall", "[-0.36,0,0]", "[0,0.5,0.5]", "motion='fixed'"),
                            "gravity=[0,0,-9.81]"),
                 "of a spacing"),
            "warning")
      << "3.6 spacings thick: 0.6 from the first liquid row";
  EXPECT_EQ(told(scene_with(liquid + steel_box("wall", "[-0.3,0,0]", "[0,0.5,0.5]", "motion='fixed'"),
                            "gravity=[0,0,-9.81]"),
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
    return scene_with(
        "[[material]]\nname='glue'\ndensity=1000\nyoung_modulus=1e6\npoisson_ratio=0.3\n" + more +
            "[[body]]\nname='bar'\nmaterial='glue'\nshape={kind='box',min=[0,0,0],max=[0.5,0.5,0.5]}\n",
        scene);
  };
  EXPECT_EQ(told(bar("fracture_stretch=1.1\n"), "pass through each other"), "warning");
  EXPECT_EQ(told(bar("fracture_stretch=1.1\nsound_speed=10\n"), "pass through each other"), "");
  EXPECT_EQ(told(bar("fracture_stretch=1.1\n", "contact='none'\n"), "pass through each other"), "");
  EXPECT_EQ(told(bar(""), "pass through each other"), "");
}

TEST(Preflight, FindsBodiesTooCoarseOrOfWrongMass) {
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.2]")), "2 particles across along z"),
            "warning");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.3]")), "across"), "");
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.396,0.5,0.5]")), "its particles weigh"), "warning")
      << "1.01 %";
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.397,0.5,0.5]")), "its particles weigh"), "")
      << "0.8 %";
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.34,0.34,0.34]")), "(-31.3 %)"), "warning");
}

/// Mass, moments and centre of particles that fit the lattice are right but for the moments of so few.
TEST(Preflight, FindsMomentsAndCentresThatAreNotThoseOfTheShape) {
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]")), "moments"), "")
      << "it fills its shape";
  const auto note = [](const std::string& text) -> std::string {
    const auto scene = scene_for(read_text(text).value, {});
    const auto notes = moment_notes(scene, sample(scene));
    return notes.empty() ? "" : notes.front().what;
  };
  EXPECT_NE(note(scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]"))).find("-4.0 % off"),
            std::string::npos)
      << "(1/5)^2 low";
  EXPECT_EQ(note(scene_with(steel_box("a", "[0,0,0]", "[1.2,1.2,1.2]"))), "") << "12 across";
  EXPECT_EQ(told(scene_with(steel_box("a", "[0,0,0]", "[1.23,1.2,1.2]")), "centre of mass is 0.015 m off"),
            "warning");
  EXPECT_EQ(
      told(scene_with(steel_box("a", "[0,0,0]", "[1.23,1.2,1.2]", "motion='fixed'")), "its particles weigh"),
      "")
      << "a wall has no use for them";
  const std::string tube =
      "{kind='difference',from={kind='box',min=[0,0,0],max=[1.2,1.2,1.2]},minus={kind='box',min=[0.4,0.4,-1],"
      "max=[0.8,"
      "0.8,2]}}";
  EXPECT_EQ(told(scene_with(body("a", tube)), "weigh"), "");
  EXPECT_EQ(told(scene_with(body("a",
                                 "{kind='union',of=[{kind='box',min=[0,0,0],max=[1.2,0.6,1.2]},{kind='box',"
                                 "min=[0,0.6,0],max=[1.2,"
                                 "1.2,1.2]}]}")),
                 "weigh"),
            "");
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
  EXPECT_EQ(
      told("[case]\nexpect='diverges'\n" + scene_with(spin, "time_step=0.051"), "rotation of body \"a\""),
      "warning")
      << "a case may be meant to diverge";
}

TEST(Preflight, FindsKeyframesThatTurnTooFarOrJump) {
  const auto board = [](const std::string& first, const std::string& rotation) {
    return scene_with(steel_box("a", "[0,0,0]", "[0.5,0.5,0.5]",
                                "motion='prescribed'\nkeyframes=[{time=0,position=" + first +
                                    "},{time=1,position=[1,1,1],rotation=" + rotation + "}]"));
  };
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[0.1,0,0,0.99498743710662]"), "half a turn"), "");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[0,0,0,1]"), "half a turn"), "error");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[-0.1,0,0,0.99498743710662]"), "half a turn"), "error");
  EXPECT_EQ(told(board("[0.25,0.25,0.25]", "[1,0,0,0]"), "jumps"), "");
  EXPECT_EQ(told(board("[0.26,0.25,0.25]", "[1,0,0,0]"), "jumps"), "warning");
  EXPECT_EQ(told(board("[1,0.25,0.25]", "[1,0,0,0]"), "jumps"), "error");
  const std::string turned =
      "motion='prescribed'\nkeyframes=[{time=0,position=[0.25,0.25,0.25],rotation=[0.6,0.8,0,0]},{time=1,"
      "position=[1,1,1],"
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
    return "[scene]\nend_time=1\n[[body]]\nname='b'\nmaterial='" + material +
           "'\nshape={kind='box',min=[0,0,0],max=[1,1,1]}\n" + more;
  };
  EXPECT_EQ(names(one("steel")), "rigid");
  EXPECT_EQ(names(one("steel", "motion='fixed'\ntemperature=300")), "heat")
      << "what is held in place only conducts";
  EXPECT_EQ(names(one("steel", "temperature=300")), "rigid heat");
  EXPECT_EQ(names(one("water")), "carried_liquid");
  EXPECT_EQ(names(one("water", "temperature=300")), "carried_liquid heat");
  EXPECT_EQ(names(one("rubber")), "elastic");
  EXPECT_EQ(names(one("ice", "temperature=250\nmotion='fixed'")), "heat")
      << "nothing in the scene is above its melting point";
  EXPECT_EQ(names(one("ice",
                      "temperature={kind='step',point=[0.5,0,0],normal=[1,0,0],behind=250,ahead=290}\nmotion="
                      "'fixed'\nphase='rigid'")),
            "heat phase");
}

}  // namespace
}  // namespace tripoint::test
