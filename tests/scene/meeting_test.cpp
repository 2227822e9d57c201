// SPDX-License-Identifier: BSD-3-Clause
#include "scene/meeting.hpp"

#include <gtest/gtest.h>

#include "case_file.hpp"
#include "sampling/sample.hpp"

namespace tripoint::test {
namespace {

constexpr const char* stone =
    "[[material]]\nname='stone'\ndensity=1000\n[[material]]\nname='gum'\ndensity=1000\nyoung_modulus="
    "1e6\npoisson_ratio=0.3\n";

std::string stone_scene(const std::string& keys) {
  return "[scene]\nend_time=1\nspacing=0.1\n" + keys + "\n" + stone;
}
std::string box(const std::string& name, const std::string& min, const std::string& max,
                const std::string& more = "", const std::string& material = "stone") {
  return "[[body]]\nname='" + name + "'\nmaterial='" + material + "'\nshape={kind='box',min=" + min +
         ",max=" + max + "}\n" + more + "\n";
}
std::string stone_cube(const std::string& name, const std::string& x, const std::string& more = "") {
  return box(name, "[" + x + ",0,0]", "[" + std::to_string(std::stod(x) + 0.5) + ",0.5,0.5]", more);
}

/// "a-b a-c": the pairs that can meet.
std::string pairs(const std::string& text) {
  const Scene s = read_text(text).value.scene;
  std::string list;
  for (const Meeting& m : meetings(s))
    list += (list.empty() ? "" : " ") + s.bodies[m.a].name + "-" + s.bodies[m.b].name;
  return list;
}

constexpr const char* falls = "gravity=[0,0,-9.81]";
const std::string plate = box("plate", "[-1,-1,-0.3]", "[1,1,0]", "motion='fixed'");

TEST(Meetings, AreOfWhatFallsOnAPlateInTime) {
  EXPECT_EQ(pairs(stone_scene(falls) + plate + box("block", "[0,0,1]", "[0.3,0.3,1.3]")), "plate-block");
  EXPECT_EQ(pairs(stone_scene(falls) + plate + box("block", "[0,0,8]", "[0.3,0.3,8.3]")), "")
      << "4.9 m in 1 s";
  EXPECT_EQ(pairs(stone_scene(falls) + plate + box("block", "[3,0,1]", "[3.3,0.3,1.3]")), "") << "beside it";
  EXPECT_EQ(pairs(stone_scene(falls) + plate + box("block", "[3,0,1]", "[3.3,0.3,1.3]", "velocity=[-6,0,0]")),
            "plate-block")
      << "thrown there";
  EXPECT_EQ(pairs(stone_scene(falls) + plate + box("block", "[3,0,1]", "[3.3,0.3,1.3]", "velocity=[-3,0,0]")),
            "")
      << "it is below when it is there";
  EXPECT_EQ(pairs(stone_scene("gravity=[0,0,9.81]") + plate + box("block", "[0,0,1]", "[0.3,0.3,1.3]")), "")
      << "it falls upwards";
}

TEST(Meetings, AreNotOfBodiesThatFlySideBySide) {
  EXPECT_EQ(pairs(stone_scene(falls) + stone_cube("a", "0", "velocity=[1,2,3]") +
                  stone_cube("b", "0.5", "velocity=[1,2,3]")),
            "")
      << "gravity moves both alike";
  EXPECT_EQ(pairs(stone_scene(falls) + stone_cube("a", "0", "velocity=[1,2,3]") +
                  stone_cube("b", "1", "velocity=[0,2,3]")),
            "a-b");
  EXPECT_EQ(pairs(stone_scene(falls) + stone_cube("a", "0", "velocity=[0,2,3]") +
                  stone_cube("b", "1", "velocity=[1,2,3]")),
            "")
      << "they part";
}

TEST(Meetings, CountTheSphereOfWhatTurns) {
  EXPECT_EQ(
      pairs(stone_scene("") + stone_cube("a", "0") + stone_cube("b", "0.61", "angular_velocity=[0,0,1]")),
      "a-b");
  EXPECT_EQ(
      pairs(stone_scene("") + stone_cube("a", "0") + stone_cube("b", "0.9", "angular_velocity=[0,0,1]")), "");
}

TEST(Meetings, FollowKeyframes) {
  const auto ram = [](const std::string& to) {
    return stone_cube(
        "ram", "-2",
        "motion='prescribed'\nkeyframes=[{time=0,position=[-1.75,0.25,0.25]},{time=1,position=[" + to +
            ",0.25,0.25]}]");
  };
  EXPECT_EQ(pairs(stone_scene("") + ram("-0.3") + stone_cube("a", "0")), "ram-a");
  EXPECT_EQ(pairs(stone_scene("") + ram("-1") + stone_cube("a", "0")), "");
  EXPECT_EQ(pairs(stone_scene("") + ram("-0.3") + stone_cube("a", "0", "motion='fixed'")), "")
      << "nothing there is moved by forces";
}

TEST(Meetings, AreNotOfJoinedBodiesButOfWhatTheyCarry) {
  const std::string clamp = stone_cube("clamp", "-0.5", "motion='fixed'"),
                    tip = stone_cube("tip", "0.5", "joined_to=['bar']");
  const std::string bar = box("bar", "[0,0,0]", "[0.5,0.5,0.5]", "joined_to=['clamp']", "gum");
  EXPECT_EQ(pairs(stone_scene(falls) + clamp + bar), "");
  EXPECT_EQ(
      pairs(stone_scene(falls) + clamp + bar + box("floor", "[-1,-1,-1]", "[2,2,-0.5]", "motion='fixed'")),
      "bar-floor");
  EXPECT_NE(pairs(stone_scene("") + stone_cube("ram", "-0.5", "motion='prescribed'\nvelocity=[3,0,0]") +
                  box("bar", "[0,0,0]", "[0.5,0.5,0.5]", "joined_to=['ram']", "gum") +
                  stone_cube("wall", "3", "motion='fixed'"))
                .find("bar-wall"),
            std::string::npos)
      << "it is pushed there";
}

TEST(Meetings, EndWithAMergerAndBeginWithARelease) {
  const std::string both =
      stone_cube("a", "0", "velocity=[1,0,0]") + stone_cube("b", "1.2", "velocity=[-1,0,0]");
  EXPECT_EQ(pairs(stone_scene("") + both), "a-b");
  EXPECT_EQ(pairs(stone_scene("") + both + "[[event]]\nkind='merge'\ntime=0.2\nbodies=['a','b']\n"), "")
      << "0.3 m apart when they become one";
  const std::string held = plate + box("block", "[0,0,1]", "[0.3,0.3,1.3]", "motion='fixed'");
  EXPECT_EQ(pairs(stone_scene(falls) + held), "");
  EXPECT_EQ(pairs(stone_scene(falls) + held + "[[event]]\nkind='release'\ntime=0.2\nbodies=['block']\n"),
            "plate-block");
}

TEST(Meetings, ReachAcrossAPeriodicSide) {
  const std::string domain = "min=[0,0,0]\nmax=[4,1,1]\nperiodic=['x']\n";
  const std::string two = stone_cube("a", "3", "velocity=[1,0,0]") + stone_cube("b", "0", "motion='fixed'");
  EXPECT_EQ(pairs(stone_scene("min=[0,0,0]\nmax=[4,1,1]") + two), "");
  EXPECT_EQ(pairs(stone_scene(domain) + two), "a-b");
}

double stiffness(const std::string& text) {
  const auto k = default_stiffness(read_text(text).value.scene);
  return k ? k->value : 0.0;
}

TEST(DefaultStiffnessOfSolids, ComesFromTheFallAndTheSpeedOfApproach) {
  EXPECT_NEAR(stiffness(stone_scene(falls) + plate + box("block", "[0,0,1]", "[0.3,0.3,1.3]")),
              100.0 * 2.0 * 9.81 * 1.6, 1e-9)
      << "height of the scene";
  EXPECT_NEAR(stiffness(stone_scene("") + stone_cube("a", "0", "velocity=[1,0,0]") +
                        stone_cube("b", "1", "velocity=[-1,0,0]")),
              400.0, 1e-9)
      << "2 m/s";
  EXPECT_EQ(stiffness(stone_scene("") + stone_cube("a", "0", "velocity=[-1,0,0]") +
                      stone_cube("b", "1", "velocity=[1,0,0]")),
            0.0)
      << "they part";
}

TEST(DefaultStiffnessOfSolids, IsThatOfAnElasticBodyWhereThatIsMore) {
  const double modulus = 1e6 * 0.7 / (1.3 * 0.4);
  EXPECT_NEAR(stiffness(stone_scene("") + box("ball", "[0,0,0]", "[0.5,0.5,0.5]", "velocity=[1,0,0]", "gum") +
                        stone_cube("wall", "1", "motion='fixed'")),
              modulus / 1000.0, 1e-9);
}

TEST(DefaultStiffnessOfSolids, IsNoneWhereTheCaseSaysSo) {
  const std::string two = stone_cube("a", "0", "velocity=[1,0,0]") + stone_cube("b", "1");
  EXPECT_GT(stiffness(stone_scene("") + two), 0.0);
  EXPECT_EQ(stiffness(stone_scene("contact='none'") + two), 0.0);
  EXPECT_NE(refusal("[scene]\nend_time=1\ncontact='none'\n[[body]]\nname='b'\nmaterial='water'\nshape={kind='"
                    "box',min=[0,0,0],"
                    "max=[1,1,1]}\n")
                .find("scene.contact"),
            std::string::npos);
}

TEST(EscapeDomain, HoldsFreeFlightsButNoFallThroughAFloor) {
  const auto domain = [](const std::string& text) {
    const Scene s = read_text(text).value.scene;
    return escape_domain(s, sample(s));
  };
  const auto flight = domain(stone_scene(falls) + stone_cube("a", "0", "velocity=[10,0,20]"));
  EXPECT_GT(flight.max.x, 10.0);
  EXPECT_GT(flight.max.z, 15.0);
  const auto fall = domain(stone_scene(falls) + stone_cube("a", "0"));
  EXPECT_LT(fall.min.z, -4.9);
  const auto floor = domain(stone_scene(falls) + plate + box("block", "[0,0,0]", "[0.3,0.3,0.3]"));
  EXPECT_GT(floor.min.z, -7.0) << "twice the diagonal of 2.8 m and the plate; no free fall of 4.9 m more";
  EXPECT_LT(floor.min.z, -5.0);
  const auto beside = domain(stone_scene(falls) + plate + box("block", "[9,0,0]", "[9.3,0.3,0.3]"));
  EXPECT_LT(beside.min.z, floor.min.z - 4.9) << "a plate beside it stops no fall";
}

}  // namespace
}  // namespace tripoint::test
