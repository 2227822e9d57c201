// SPDX-License-Identifier: BSD-3-Clause
// Forces are the gradient of the stored energy, and keep momentum and angular momentum, for lists of every
// kind.
#include <gtest/gtest.h>

#include "effects/solid_lab.hpp"

namespace tripoint {
namespace {

using lab::dx;

lab::Lab block(const std::array<int, 3>& count, Mode mode = Mode::corrected, double jitter = 0.1) {
  lab::Lab lab = lab::elastic_lab(dx, 0.3, mode);
  lab.add({.count = count, .phase = Phase::elastic});
  lab::jitter_all(lab, jitter,
                  {count[0] > 1 ? 1.0 : 0.0, count[1] > 1 ? 1.0 : 0.0, count[2] > 1 ? 1.0 : 0.0});
  return lab;
}

TEST(ElasticForce, IsMinusTheGradientOfTheEnergyForSolidsSheetsAndChains) {
  for (const std::array<int, 3>& count :
       {std::array{5, 4, 4}, std::array{5, 5, 1}, std::array{7, 1, 1}, std::array{2, 1, 1}}) {
    lab::Deformable body(block(count));
    body.place(lab::bent);
    // Noise of differences: 1e-16 U/(step f)
    EXPECT_LT(worst_gradient_error(body), 1e-7) << count[0] << count[1] << count[2];
  }
}

TEST(ElasticForce, OfASolidWithFlatPartsIsTheGradientToo) {
  lab::Lab lab = block({4, 4, 3});
  lab.add({.name = "fin", .corner = {4.0 * dx, 0.0, dx}, .count = {3, 4, 1}, .phase = Phase::elastic});
  lab.scene.bodies.back().joined_to = {"block"};
  lab::Deformable body(lab);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticForce, AsPrintedIsTheGradientOfThePrintedEnergy) {
  lab::Deformable body(block({4, 4, 4}, Mode::paper));
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticForce, WithoutHourglassIsTheGradientToo) {
  lab::Lab lab = block({4, 4, 4});
  lab.scene.values["hourglass"] = 0.0;
  lab::Deformable body(lab);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticForce, ReachesAsFarAsTheSceneSays) {
  for (const auto& [reach, within] :
       // Vectors of the cubic lattice that are shorter
       {std::pair{1.2, 6U}, {1.6, 18U}, {2.12, 32U}, {2.5, 80U}}) {
    lab::Lab lab = block({7, 7, 7}, Mode::corrected, 0.0);
    lab.scene.values["bond_reach"] = reach;
    const Simulation simulation(lab.scene, lab.initial, {.threads = 1});
    EXPECT_EQ(simulation.state().bonds.of(171).size(), within) << reach;  // the middle one
    lab::Lab small = block({4, 4, 4});
    small.scene.values["bond_reach"] = reach;
    lab::Deformable body(small);
    body.place(lab::bent);
    EXPECT_LT(worst_gradient_error(body), 1e-7) << reach;
  }
}

TEST(ElasticForce, KeepsMomentumAndAngularMomentumToRoundOff) {
  for (const std::array<int, 3>& count : {std::array{5, 4, 4}, std::array{5, 5, 1}, std::array{7, 1, 1}}) {
    lab::Deformable body(block(count));
    body.place(lab::bent);
    Vec3 sum, torque;
    double forces = 0.0, torques = 0.0;
    for (std::size_t id = 0; id < body.size(); ++id) {
      const Vec3 f = body.force(id), r = body.state().particles.position(body.state().particles.row(id));
      sum += f;
      torque += cross(r, f);
      forces += norm(f);
      torques += norm(r) * norm(f);
    }
    EXPECT_LT(norm(sum) / forces, 1e-13);
    EXPECT_LT(norm(torque) / torques, 1e-13);
  }
}

TEST(ElasticForce, OfListsThatDoNotMirrorEachOtherIsTheGradientStill) {
  lab::Deformable body(block({4, 4, 4}));
  State& w = body.state();
  // One particle keeps its list in a frame of its own, as after freezing (x_ij != -x_ji).
  const Quaternion q = from_rotation_vector({0.2, 0.9, -0.4});
  const ElasticityKernel kernel = solid::bond_kernel(w.scene);
  for (Bond& b : w.bonds.edit(21)) {
    const Bond turned = solid::bond_of(kernel, 1.02 * rotate(q, b.x));
    b.x = turned.x;
    b.gradient = turned.gradient;
    b.weight = turned.weight;
  }
  solid::refresh_shapes(w, std::vector<std::uint32_t>{21});
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticForce, AcrossTheSeamOfAPeriodicBoxIsThatOfTheSameBarElsewhere) {
  const auto bar = [](double offset) {
    lab::Lab lab = lab::elastic_lab(dx);
    lab.add({.corner = {0.05, 0.05, 0.05}, .count = {4, 6, 3}, .phase = Phase::elastic});
    lab.make_periodic({false, true, false}, {0.05, 0.05, 0.05}, {4, 6, 3});
    for (Vec3& r : lab.initial.position) r.y = std::fmod(r.y + offset, 0.6);
    return lab;
  };
  lab::Deformable here(bar(0.0)), there(bar(0.3));
  const auto squeezed = [](const Vec3& r) { return Vec3{1.02 * r.x, r.y, 0.98 * r.z}; };
  here.place(squeezed);
  there.place(squeezed);
  for (std::size_t id = 0; id < here.size(); ++id)
    EXPECT_NEAR(norm(here.force(id) - there.force(id)), 0.0, 1e-13 * dx * dx);
  EXPECT_GT(here.greatest_force(), 1e-3 * dx * dx);
}

TEST(ElasticForce, OnTheMembersOfARigidBodyIsWhatTheirElasticPartnersGive) {
  lab::Lab lab = block({4, 4, 4});
  lab.add({.name = "clamp",
           .corner = {-2.0 * dx, 0.0, 0.0},
           .count = {2, 4, 4},
           .phase = Phase::elastic,
           .motion = Motion::fixed});
  lab.scene.bodies[0].joined_to = {"clamp"};
  lab::Deformable body(lab);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
  Vec3 on_clamp, on_block;
  for (std::size_t id = 0; id < body.size(); ++id) (id < 64 ? on_block : on_clamp) += body.force(id);
  EXPECT_GT(norm(on_clamp), 1e-3 * dx * dx);
  EXPECT_NEAR(norm(on_clamp + on_block), 0.0, 1e-13 * dx * dx);
}

}  // namespace
}  // namespace tripoint
