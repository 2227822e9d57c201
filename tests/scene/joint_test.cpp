// SPDX-License-Identifier: BSD-3-Clause
// What a [[joint]] may say, and what it is refused for.
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "scene/joints.hpp"
#include "scene/meeting.hpp"
#include "validation/case/preflight.hpp"

namespace tripoint::test {
namespace {

std::string two_bodies(const std::string& joint, const std::string& of_b = "") {
  return "[scene]\nend_time = 1\nspacing = 0.1\n[[material]]\nname='m'\ndensity=1000\n"
         "[[body]]\nname='a'\nmaterial='m'\nphase='rigid'\nshape={kind='box',min=[0,0,0],max=[0.3,0.3,0.3]}\n"
         "[[body]]\nname='b'\nmaterial='m'\nphase='rigid'\nshape={kind='box',min=[0.4,0,0],max=[0.7,0.3,0.3]}"
         "\n" +
         of_b + "[[joint]]\nname='j'\nplace=[0.35,0.1,0.1]\n" + joint;
}

Joint joint_of(const std::string& text) { return read_text(two_bodies(text)).value.scene.joints.at(0); }

TEST(JointKeys, KeepWhatTheCaseSays) {
  const Joint j = joint_of(
      "kind='hinge'\nbodies=['a','b']\naxis=[0,2,0]\nlimits=[-1,0.5]\nfriction=0.1\ndamping=0.2\n"
      "spring={stiffness=3,rest=0.1}\nmotor={effort=4}\n");
  EXPECT_EQ(j.kind, Joint::Kind::hinge);
  EXPECT_EQ(j.bodies, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(*j.axis, (Vec3{0, 1, 0})) << "of unit length";
  EXPECT_EQ((*j.limits)[0], -1.0);
  EXPECT_EQ((*j.limits)[1], 0.5);
  EXPECT_EQ(j.friction, 0.1);
  EXPECT_EQ(j.damping, 0.2);
  EXPECT_EQ(j.spring->stiffness, 3.0);
  EXPECT_EQ(j.spring->rest, 0.1);
  EXPECT_EQ(*j.motor->effort, 4.0);
  EXPECT_FALSE(j.motor->speed);
}

TEST(JointKeys, TakeUnits) {
  EXPECT_NEAR((*joint_of("kind='hinge'\nbodies=['a','b']\naxis=[0,1,0]\nlimits=[-1,1]\n").limits)[1], 1.0,
              0.0);
  EXPECT_EQ(joint_of("kind='ball'\nbodies=['a','world']\n").bodies[1], "world");
}

TEST(JointKeys, BelongToTheirKinds) {
  const std::string ends = "bodies=['a','b']\n";
  expect_refused(two_bodies("kind='hinge'\n" + ends), {"needs the key `axis`"});
  expect_refused(two_bodies("kind='slider'\naxis=[0,0,0]\n" + ends), {"no length"});
  expect_refused(two_bodies("kind='ball'\naxis=[0,0,1]\n" + ends), {"ball does not read it"});
  expect_refused(two_bodies("kind='distance'\n" + ends), {"needs the key `other_place`"});
  expect_refused(two_bodies("kind='universal'\naxis=[0,0,1]\nother_axis=[0,1,1]\n" + ends), {"right angles"});
  expect_refused(two_bodies("kind='ball'\ndamping=1\n" + ends), {"only a hinge and a slider"});
  expect_refused(two_bodies("kind='hinge'\naxis=[0,0,1]\nlimits=[0.1,1]\n" + ends), {"low <= 0 <= high"});
  expect_refused(two_bodies("kind='hinge'\naxis=[0,0,1]\nmotor={}\n" + ends), {"motor = { effort"});
  expect_refused(two_bodies("kind='rope'\n" + ends), {"hinge"});
}

TEST(JointKeys, NameBodiesThatCanBeHeld) {
  const std::string ball = "kind='ball'\n";
  expect_refused(two_bodies(ball + "bodies=['a','c']\n"), {"c"});
  expect_refused(two_bodies(ball + "bodies=['a','a']\n"), {"twice"});
  expect_refused(two_bodies(ball + "bodies=['a']\n"), {"write two bodies"});
  expect_refused(two_bodies(ball + "bodies=['b','world']\n", "motion='fixed'\n"), {"neither body is free"});
  expect_refused(two_bodies(ball + "bodies=['a','b']\n", "motion='prescribed'\nvelocity=[1,0,0]\n"),
                 {"is prescribed"});
  expect_refused(two_bodies(ball + "bodies=['a','b']\n[[joint]]\nname='j'\nkind='ball'\nplace=[0,0,0]\n"
                                   "bodies=['a','world']\n"),
                 {"j"});
}

TEST(JointKeys, KeepBodiesThatTheyHoldFromTouching) {
  const Scene held = read_text(two_bodies("kind='ball'\nbodies=['b','a']\n")).value.scene;
  EXPECT_TRUE(has_joint(held, "a", "b"));
  EXPECT_TRUE(meetings(held).empty());
  const Scene apart = read_text(two_bodies("kind='ball'\nbodies=['b','world']\n")).value.scene;
  EXPECT_FALSE(has_joint(apart, "a", "b"));
  EXPECT_FALSE(meetings(apart).empty()) << "one of them no longer flies straight";
}

TEST(JointKeys, RefuseLimitsThatNothingKeeps) {
  const std::string hinge = "kind='hinge'\nbodies=['a','b']\naxis=[0,1,0]\n";
  expect_refused(two_bodies(hinge + "limits=[-1,1]\nmotor={speed=2}\n"), {"effort"});
  expect_refused(two_bodies(hinge + "restitution=0.5\n"), {"restitution"});
  EXPECT_EQ(joint_of(hinge + "limits=[-1,1]\nrestitution=0.5\n").restitution, 0.5);
}

std::string warned(const std::string& joints) {
  std::string all, text = two_bodies(joints);
  text.replace(text.find("[[material]]"), 0, "contact='none'\n");
  for (const Finding& f : joint_findings(read_text(text).value.scene)) all += f.what + "\n";
  return all;
}

TEST(JointFindings, NameJointsThatLeaveNoFreedom) {
  const std::string hinge = "kind='hinge'\nbodies=['a','world']\naxis=[0,1,0]\n",
                    next = "[[joint]]\nname='k'\nkind='hinge'\nplace=[0.5,0.1,0.1]\nbodies=['b','a']\n";
  EXPECT_EQ(warned(hinge + next + "axis=[0,1,0]\n"), "");
  const std::string back = "[[joint]]\nname='l'\nkind='hinge'\nbodies=['b','world']\n";
  EXPECT_EQ(warned(hinge + next + "axis=[0,1,0]\n" + back + "place=[0.35,0.9,0.1]\naxis=[0,1,0]\n"), "")
      << "a and b turn together about one line";
  EXPECT_NE(warned(hinge + next + "axis=[0,1,0]\n" + back + "place=[0.9,0.1,0.1]\naxis=[1,0,0]\n")
                .find("\"j\", \"k\", \"l\" leave no freedom"),
            std::string::npos);
}

TEST(JointFindings, NameMotorsThatFightAndBodiesThatNothingHolds) {
  const std::string pair =
      "kind='hinge'\nbodies=['a','b']\naxis=[0,1,0]\nmotor={speed=2}\n[[joint]]\nname='k'\n"
      "kind='hinge'\nplace=[0.35,0.7,0.1]\nbodies=['b','a']\naxis=[0,1,0]\n";
  EXPECT_EQ(warned(pair + "motor={speed=-2}\n"), "");
  EXPECT_NE(warned(pair + "motor={speed=2}\n").find("turn against each other"), std::string::npos);
  EXPECT_NE(warned("kind='ball'\nbodies=['a','world']\n").find("holds body \"b\""), std::string::npos);
}

}  // namespace
}  // namespace tripoint::test
