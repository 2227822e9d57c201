// SPDX-License-Identifier: BSD-3-Clause
// Scenes of one layer of particles.
#include <gtest/gtest.h>

#include <numbers>

#include "case_file.hpp"
#include "sampling/sample.hpp"
#include "sampling/shape_distance.hpp"
#include "scene/geometry.hpp"

namespace tripoint::test {
namespace {

using std::numbers::pi;

std::string planar_text(const std::string& body, const std::string& scene = "") {
  return "[scene]\nend_time = 1\nspacing = 0.1\ndimensions = 2\n" + scene +
         "\n[[material]]\nname='m'\ndensity=1000\n[[body]]\nname='b'\nmaterial='m'\n" + body;
}

constexpr const char* slab = "shape={kind='box',min=[0,0,0],max=[0.4,0.3,0.2]}\n";

InitialState planar_sample(const std::string& body, const std::string& scene = "") {
  return sample(read_text(planar_text(body, scene)).value.scene);
}

TEST(Planar, ABodyIsOneLayerAtYZeroAndWeighsAMetreOfDepth) {
  const auto s = planar_sample(slab);
  ASSERT_EQ(s.size(), 8U);
  double mass = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(s.position[i].y, 0.0);
    mass += s.mass[i];
  }
  EXPECT_NEAR(mass, 1000.0 * 0.4 * 0.2 * 1.0, 1e-9);
}

/// A shape counts without its y, wherever along y it was drawn.
TEST(Planar, ABallIsADisc) {
  const auto scene = read_text(planar_text("shape={kind='sphere',centre=[0,7,0],radius=0.5}")).value.scene;
  EXPECT_NEAR(*volume(scene.bodies[0].shape), pi * 0.25, 1e-12);
  const auto whole = mass_of_shape(scene.bodies[0].shape, 1.0, 0.01, Dimensions::two);
  EXPECT_NEAR(whole->principal_inertia.z, 0.5 * pi * 0.25 * 0.25, 1e-3) << "of a disc, about y";
}

TEST(Planar, ACylinderAcrossThePlaneIsADiscAndOneInItARectangle) {
  const auto of = [](const std::string& shape) {
    return *volume(read_text(planar_text("shape=" + shape)).value.scene.bodies[0].shape);
  };
  EXPECT_NEAR(of("{kind='cylinder',base=[0,0,0],axis=[0,1,0],length=3,radius=0.2}"), pi * 0.04, 1e-12);
  EXPECT_NEAR(of("{kind='cylinder',base=[0,0,0],axis=[1,0,1],length=3,radius=0.2}"), 1.2, 1e-12);
}

TEST(Planar, JitterLeavesTheLayerPlane) {
  for (const Vec3& r : planar_sample(slab, "jitter = 0.3").position) EXPECT_EQ(r.y, 0.0);
}

TEST(Planar, RefusesWhatPointsOutOfThePlane) {
  const auto says = [](const std::string& body, const std::string& scene = "") {
    return refusal(planar_text(body, scene)).find("x and z") != std::string::npos;
  };
  EXPECT_TRUE(says(slab, "gravity = [0, -9.81, 0]"));
  EXPECT_TRUE(says(slab, "periodic = ['y']\nmin = [0, 0, 0]\nmax = [1, 1, 1]"));
  EXPECT_TRUE(says(std::string(slab) + "phase = 'rigid'\nangular_velocity = [0, 0, 1]"));
  EXPECT_TRUE(says(std::string(slab) + "phase = 'rigid'\nvelocity = [0, 1, 0]"));
  EXPECT_TRUE(says("shape={kind='cylinder',base=[0,0,0],axis=[0,1,1],length=3,radius=0.2}"));
  EXPECT_FALSE(says(slab, "gravity = [0, 0, -9.81]"));
  EXPECT_NE(refusal("[scene]\nend_time = 1\ndimensions = 4\n"), "");
  EXPECT_NE(refusal("[scene]\nend_time = 1\nplane = 'stress'\n").find("write dimensions = 2 too"),
            std::string::npos);
}

}  // namespace
}  // namespace tripoint::test
