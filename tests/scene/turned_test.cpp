// SPDX-License-Identifier: BSD-3-Clause
// Shapes and bodies that start turned, laws of contact and constant forces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_file.hpp"
#include "sampling/sample.hpp"
#include "scene/contact_law.hpp"
#include "scene/geometry.hpp"

namespace tripoint::test {
namespace {

using std::numbers::pi;

std::string turned_text(const std::string& body, const std::string& more = "") {
  return "[scene]\nend_time = 1\nspacing = "
         "0.1\n[[material]]\nname='m'\ndensity=1000\n[[body]]\nname='b'\nmaterial='m'\n" +
         body + "\n" + more;
}

Scene turned_scene(const std::string& body, const std::string& more = "") {
  return read_text(turned_text(body, more)).value.scene;
}

constexpr const char* ingot = "shape={kind='box',min=[1,2,3],max=[1.6,2.4,3.2]}";
// 90 degrees about z, and 0.7 rad about (1, 2, 2)/3.
constexpr const char
    *quarter = "rotation=[0.7071067811865476,0,0,0.7071067811865476]",
    *askew = "rotation=[0.9393727128473789,0.11429926915020388,0.22859853830040776,0.22859853830040776]";

TEST(Turned, ABoxByAQuarterTurnChangesItsSidesAboutItsCentre) {
  const auto s = turned_scene(std::string(ingot) + "\n" + quarter);
  const Bounds b = bounds(s.bodies[0].shape);
  EXPECT_LT(norm(b.min - Vec3{1.1, 1.9, 3.0}), 1e-12);
  EXPECT_LT(norm(b.max - Vec3{1.5, 2.5, 3.2}), 1e-12);
}

TEST(Turned, ABodyKeepsItsParticlesMassAndMomentsAtAnyAngle) {
  const auto upright = sample(turned_scene(ingot)),
             turned = sample(turned_scene(std::string(ingot) + "\n" + askew));
  ASSERT_EQ(upright.size(), turned.size());
  const auto a = mass_properties(upright.position, upright.mass),
             b = mass_properties(turned.position, turned.mass);
  EXPECT_LT(norm(a.centre - b.centre), 1e-12);
  EXPECT_LT(norm(a.principal_inertia - b.principal_inertia), 1e-10 * norm(a.principal_inertia));
}

TEST(Turned, TheShapeHoldsItsParticlesAndNothingBeyondItsFaces) {
  const auto s = turned_scene(std::string(ingot) + "\n" + askew);
  const auto inside = inside_of(s.bodies[0].shape, 0.1);
  for (const Vec3& r : sample(s).position) EXPECT_TRUE(inside(r));
  const auto map = turning(s.bodies[0].shape);
  EXPECT_TRUE(inside(map({1.59, 2.39, 3.19})));
  EXPECT_FALSE(inside(map({1.61, 2.39, 3.19})));
}

TEST(Turned, ABodyCanBeCutOutOfAnotherWithTheSameRotation) {
  const auto s = turned_scene(
      "shape={kind='difference',from={kind='box',min=[0,0,0],max=[2,4,6]},minus={kind='box',min=[1,2,3],"
      "max=[1.6,2.4,3.2]," +
      std::string(askew) + "}}");
  const auto hole = turned_scene(std::string(ingot) + "\n" + askew);
  const auto cut = inside_of(hole.bodies[0].shape, 0.1);
  for (const Vec3& r : sample(s).position) EXPECT_FALSE(cut(r));
}

TEST(Turned, ARotationThatIsNoneIsRefusedByName) {
  expect_refused(turned_text(std::string(ingot) + "\nrotation=[0,0,0,0]"),
                 {"body.b.rotation", "the quaternion has length 0"});
  expect_refused(turned_text(std::string(ingot) + "\nrotation=[1,0,0]"),
                 {"rotation", "write the quaternion [w, x, y, z]"});
  expect_refused(
      turned_text("shape={kind='box',min=[1,2,3],max=[1.6,2.4,3.2]," + std::string(askew) + "}\n" + quarter),
      {"its shape has a rotation too"});
}

const std::string three_bodies =
    "[scene]\nend_time=1\nspacing=0.1\n[[material]]\nname='slick'\ndensity=900\n[[material]]\nname='steel'"
    "\ndensity=7800\n"
    "[[body]]\nname='floor'\nmaterial='steel'\nmotion='fixed'\nphase='rigid'\nshape={kind='box',min=[0,0,-0."
    "2],max=[2,2,0]}\n"
    "[[body]]\nname='a'\nmaterial='slick'\nphase='rigid'\nshape={kind='box',min=[0,0,0],max=[0.2,0.2,0.2]}\n"
    "[[body]]\nname='c'\nmaterial='slick'\nphase='rigid'\nshape={kind='box',min=[1,0,0],max=[1.2,0.2,0.2]}\n";

TEST(ContactLaw, IsOfAPairInEitherOrder) {
  const auto s =
      read_text(three_bodies + "[[contact]]\nmaterials=['steel','slick']\nfriction=0.02\n").value.scene;
  ASSERT_NE(contact_law_of(s, "slick", "steel"), nullptr);
  EXPECT_EQ(contact_law_of(s, "steel", "slick")->friction, 0.02);
  EXPECT_EQ(contact_law_of(s, "slick", "slick"), nullptr);
}

TEST(ContactLaw, IsCommonOnlyWhereAllPairsThatCanMeetHaveIt) {
  const std::string steel_on_ice = "[[contact]]\nmaterials=['steel','slick']\nfriction=0.02\n";
  const auto some = common_contact(read_text(three_bodies + steel_on_ice).value.scene);
  EXPECT_TRUE(some.differs) << "ice on ice has none";
  const auto all = common_contact(
      read_text(three_bodies + steel_on_ice + "[[contact]]\nmaterials=['slick','slick']\nfriction=0.02\n")
          .value.scene);
  EXPECT_FALSE(all.differs);
  EXPECT_EQ(all.friction, 0.02);
  EXPECT_FALSE(common_contact(read_text(three_bodies).value.scene).friction);
}

TEST(ContactLaw, OfNoMaterialOrWrittenTwiceIsRefused) {
  const std::string law = "[[contact]]\nmaterials=['steel','slick']\nfriction=0.02\n";
  expect_refused(three_bodies + "[[contact]]\nmaterials=['steel','slickk']\nfriction=0.1\n",
                 {"no material is named \"slickk\"", "slick"});
  expect_refused(three_bodies + law + "[[contact]]\nmaterials=['slick','steel']\nfriction=0.3\n",
                 {"have a [[contact]] already"});
  expect_refused(three_bodies + "[[contact]]\nmaterials=['steel','slick']\n",
                 {"give the friction or the restitution"});
  expect_refused(three_bodies + "[[contact]]\nmaterials=['steel','slick']\nrestitution=1.2\n",
                 {"from 0 to 1"});
}

TEST(Region, HoldsImagesOfAPointBeyondPeriodicSidesAlone) {
  Scene s = turned_scene(ingot);
  s.min = {0, 0, 0};
  s.max = {2, 4, 4};
  s.periodic = {true, false, false};
  Shape strip, left;
  strip.kind = Shape::Kind::box;
  strip.min = {-0.1, 0, 0};
  strip.max = {0.1, 4, 4};
  left.kind = Shape::Kind::half_space;
  left.point = {1, 0, 0};
  left.normal = {1, 0, 0};
  const auto about_a_side = inside_region(s, strip);
  for (const double x : {0.05, 1.95, 4.05, -2.05}) EXPECT_TRUE(about_a_side({x, 1, 1})) << x;
  for (const double x : {0.15, 1.85, 5.0}) EXPECT_FALSE(about_a_side({x, 1, 1})) << x;
  EXPECT_FALSE(about_a_side({0.05, 5, 1}));  // y is open
  const auto half = inside_region(s, left);
  for (const double x : {0.5, 2.5, -1.5}) EXPECT_TRUE(half({x, 1, 1})) << x;
  for (const double x : {1.5, -0.5, 3.5}) EXPECT_FALSE(half({x, 1, 1})) << x;
}

TEST(Force, ActsOnAFreeRigidBodyThatStaysOne) {
  EXPECT_EQ(refusal(three_bodies + "[[force]]\nbody='a'\nvalue=[1,0,0]\n"), "");
  expect_refused(three_bodies + "[[force]]\nbody='floor'\nvalue=[1,0,0]\n",
                 {"\"floor\" is fixed", "free rigid body"});
  expect_refused(three_bodies + "[[force]]\nbody='b'\nvalue=[1,0,0]\n", {"body"});
}

}  // namespace
}  // namespace tripoint::test
