// SPDX-License-Identifier: BSD-3-Clause
// One layer of particles: nothing leaves the plane, whatever acts.
#include <gtest/gtest.h>

#include "sampling/sample.hpp"
#include "scene/case_file.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

constexpr const char* tank = R"(
[[material]]
name = "water"
density = 1000.0
viscosity = 1.0
sound_speed = "20 m/s"
[[material]]
name = "glass"
density = 1000.0
[[material]]
name = "gum"
density = 800.0
young_modulus = 1e5
poisson_ratio = 0.3
[[material]]
name = "wood"
density = 500.0
[[body]]
name = "water"
material = "water"
phase = "liquid"
shape = { kind = "box", min = [0, 0, 0], max = [0.8, 1, 0.3] }
[[body]]
name = "tank"
material = "glass"
phase = "rigid"
motion = "fixed"
shape = { kind = "difference", from = { kind = "box", min = [-0.2, 0, -0.2], max = [1, 1, 0.8] }, minus = { kind = "box", min = [0, 0, 0], max = [0.8, 1, 2] } }
[[body]]
name = "gum"
material = "gum"
shape = { kind = "sphere", centre = [0.25, 0, 0.5], radius = 0.12 }
velocity = [0, 0, -1]
[[body]]
name = "wood"
material = "wood"
phase = "rigid"
rotation = [0.9238795325112867, 0, 0.3826834323650898, 0]
shape = { kind = "box", min = [0.5, 0, 0.42], max = [0.66, 1, 0.58] }
velocity = [0, 0, -1]
)";

Scene scene_of(const std::string& keys) {
  return test::read_text(
             "[scene]\nend_time = 1\ndimensions = 2\nspacing = \"40 mm\"\njitter = 0.05\ngravity = "
             "[0, 0, -9.81]\n" +
             keys + tank)
      .value.scene;
}

/// Ways of the particles out of the plane, and of all momentum.
void expect_in_plane(Scene scene) {
  Simulation s(scene, sample(scene));
  int steps = 0;
  s.advance_to(1.0, [&] { return ++steps < 400; });
  const Particles& p = s.state().particles;
  double moved = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(p.position(i).y, 0.0);
    ASSERT_EQ(p.velocity(i).y, 0.0);
    moved = std::max(moved, norm(p.velocity(i)));
  }
  EXPECT_GT(moved, 0.1) << "or this shows nothing";
  for (std::size_t b = 0; b < s.state().bodies.size(); ++b) {
    const Vec3 w = s.state().bodies[field::body_angular_velocity][b];
    EXPECT_EQ(w.x, 0.0);
    EXPECT_EQ(w.z, 0.0);
  }
}

TEST(Planar, NothingLeavesThePlaneWhereLiquidCarriesItsDensity) { expect_in_plane(scene_of("")); }
TEST(Planar, NothingLeavesThePlaneWhereDensityIsSummed) {
  expect_in_plane(scene_of("[model]\npressure = \"conservative\"\n"));
}
TEST(Planar, NothingLeavesThePlaneAsPrinted) {
  expect_in_plane(scene_of("clamp = true\nmode = \"paper\"\n"));
}

}  // namespace
}  // namespace tripoint
