// SPDX-License-Identifier: BSD-3-Clause
// The correction for bending (model 8.7): what it leaves as it is, and what it cures.
#include <gtest/gtest.h>

#include <numbers>

#include "effects/solid_lab.hpp"

namespace tripoint {
namespace {

using lab::dx;

lab::Lab bending_block(const std::array<int, 3>& count, double jitter = 0.1, double bending = 1.0,
                       Mode mode = Mode::corrected) {
  lab::Lab lab = lab::elastic_lab(dx, 0.3, mode);
  lab.scene.values["bending"] = bending;
  lab.add({.count = count, .phase = Phase::elastic});
  lab::jitter_all(lab, jitter,
                  {count[0] > 1 ? 1.0 : 0.0, count[1] > 1 ? 1.0 : 0.0, count[2] > 1 ? 1.0 : 0.0});
  return lab;
}

TEST(ElasticBending, ForcesAreMinusTheGradientOfTheEnergy) {
  for (const double bending : {1.0, 0.4})
    for (const std::array<int, 3>& count :
         {std::array{5, 4, 4}, std::array{6, 2, 2}, std::array{5, 5, 1}, std::array{7, 1, 1}}) {
      lab::Deformable body(bending_block(count, 0.1, bending));
      body.place(lab::bent);
      // Noise of differences
      EXPECT_LT(worst_gradient_error(body), 1e-7) << bending << ": " << count[0] << count[1] << count[2];
    }
  lab::Lab without = bending_block({4, 4, 4});
  without.scene.values["hourglass"] = 0.0;
  lab::Deformable body(without);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticBending, ForcesOfASolidWithFlatPartsAreTheGradientToo) {
  lab::Lab lab = bending_block({4, 4, 3});
  lab.add({.name = "fin", .corner = {4.0 * dx, 0.0, dx}, .count = {3, 4, 1}, .phase = Phase::elastic});
  lab.scene.bodies.back().joined_to = {"block"};
  lab::Deformable body(lab);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
}

TEST(ElasticBending, KeepsMomentumAndAngularMomentumToRoundOff) {
  lab::Deformable body(bending_block({5, 4, 4}));
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

TEST(ElasticBending, SeesNothingInARigidMotionAndAHomogeneousStrainAsItIs) {
  const Matrix3 G{0.01, 0.004, -0.003, 0.002, -0.006, 0.005, 0.001, -0.002, 0.008};
  const Symmetric expected = solid::green_strain(identity3 + G);
  for (const double jitter : {0.0, 0.2}) {
    lab::Deformable body(bending_block({5, 5, 5}, jitter));
    const Quaternion q = from_rotation_vector({1.0, -2.0, 0.5});
    body.place([&](const Vec3& r) { return rotate(q, r) + Vec3{0.3, -0.2, 0.5}; });
    EXPECT_LT(body.greatest_strain(), 1e-12);
    EXPECT_LT(body.greatest_force(), 1e-12 * dx * dx);
    body.place([&](const Vec3& r) { return r + G * r; });
    for (std::size_t id = 0; id < body.size(); ++id) {
      const Symmetric off = body.strain(id) - expected;
      EXPECT_LT(std::sqrt(contraction(off, off)), 1e-12);
    }
  }
}

/// Pure bending about z by a curvature, of a bar that is free at its sides: Saint-Venant's.
struct PureBending {
  double curvature, poisson, middle_y, middle_z;
  Vec3 operator()(const Vec3& r) const {
    const double y = r.y - middle_y, z = r.z - middle_z;
    return r + curvature * Vec3{-r.x * y, 0.5 * (r.x * r.x + poisson * (y * y - z * z)), poisson * y * z};
  }
};

/// Energy of a square bar in pure bending over the exact one, by particles far from its ends.
double energy_in_bending(int across, double bending) {
  const int length = 9;
  lab::Lab lab = bending_block({length, across, across}, 0.0, bending);
  lab.scene.values["hourglass"] = 0.0;
  lab::Deformable body(lab);
  const double middle = 0.5 * (across - 1) * dx, curvature = 1e-6 / dx;
  body.place(PureBending{curvature, 0.3, middle, middle});
  double energy = 0.0;
  for (std::uint32_t id = 0; id < body.size(); ++id)
    if (std::abs(body.state().particles.position(body.state().particles.row(id)).x - 4.0 * dx) < 0.1 * dx)
      energy += solid::deformation_energy(body.state(), id).total();
  const double inertia = std::pow(across * dx, 4) / 12.0;
  return energy / (0.5 * curvature * curvature * inertia * dx);  // of one layer, E = 1
}

TEST(ElasticBending, HasTheEnergyOfABentBarWithOrderTwo) {
  double before = 0.0;
  for (const int across : {4, 6, 8, 12}) {
    const double error = energy_in_bending(across, 1.0) - 1.0, plain = energy_in_bending(across, 0.0) - 1.0;
    // Layers at their middles have (n^2 - 1)/n^2 of the second moment
    EXPECT_NEAR(error * across * across, -1.0, 0.4) << across;
    EXPECT_LT(plain, 2.0 * error) << across;  // without it: of first order in the spacing
    if (before != 0.0) {
      EXPECT_LT(std::abs(error), std::abs(before));
    }
    before = error;
  }
}

double size(const Symmetric& e) { return std::sqrt(contraction(e, e)); }

TEST(ElasticBending, ChangesSurfacesOfSolidsAloneAndNothingAsPrinted) {
  lab::Deformable on(bending_block({7, 7, 7}, 0.0)), off(bending_block({7, 7, 7}, 0.0, 0.0));
  on.place(lab::bent);
  off.place(lab::bent);
  // The middle one: round-off of sums in another order
  EXPECT_LT(size(on.strain(171) - off.strain(171)), 1e-14);
  EXPECT_GT(size(on.strain(24) - off.strain(24)), 1e-3);  // of a face
  for (const std::array<int, 3>& count : {std::array{5, 5, 1}, std::array{7, 1, 1}}) {
    lab::Deformable flat(bending_block(count)), flat_off(bending_block(count, 0.1, 0.0));
    flat.place(lab::bent);
    flat_off.place(lab::bent);
    for (std::size_t id = 0; id < flat.size(); ++id)
      EXPECT_LT(size(flat.strain(id) - flat_off.strain(id)), 1e-14);
  }
  lab::Deformable printed(bending_block({4, 4, 4}, 0.1, 1.0, Mode::paper)),
      printed_off(bending_block({4, 4, 4}, 0.1, 0.0, Mode::paper));
  printed.place(lab::bent);
  printed_off.place(lab::bent);
  for (std::size_t id = 0; id < printed.size(); ++id) EXPECT_EQ(printed.force(id), printed_off.force(id));
}

TEST(ElasticBending, FollowsListsThatLoseBonds) {
  lab::Deformable body(bending_block({5, 5, 5}, 0.0));
  State& w = body.state();
  std::vector<std::uint32_t> ids{62};  // inside: it comes to lie at a surface
  const auto upward = [&](const Bond& b) { return b.x.y < 0.0; };
  const std::vector<std::uint32_t> lost = disconnect(w.bonds, 62, upward);
  ids.insert(ids.end(), lost.begin(), lost.end());
  solid::refresh_shapes(w, ids);
  body.place(lab::bent);
  EXPECT_LT(worst_gradient_error(body), 1e-7);
  const Bond& side = w.bonds.of(62)[0];
  // No longer along the bond
  EXPECT_GT(norm(cross(side.gradient, side.x)), 1e-3 * norm(side.gradient) * norm(side.x));
}

}  // namespace
}  // namespace tripoint
