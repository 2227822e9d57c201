// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "effects/fluid_lab.hpp"
#include "liquids/fields.hpp"

namespace tripoint {
namespace {

/// sum m |v|, what a change of momentum is measured by.
double motion_of(const Simulation& s) {
  const auto v = lab::velocities_by_id(s);
  const auto m = lab::by_id(s, field::mass);
  double sum = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += m[i] * norm(v[i]);
  return sum;
}

/// A drop of two liquids thrown together.
lab::Lab two_liquids(double light, Mode mode) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 5.0, 100.0, mode);
  const std::size_t oil = lab::add_material_like(lab, light, 1.0);
  lab.add({.name = "water", .corner = {0.0, 0.0, 0.0}, .count = {6, 6, 3}, .phase = Phase::liquid});
  lab.add({.name = "oil",
           .material = oil,
           .corner = {0.02, 0.01, 0.28},
           .count = {6, 6, 3},
           .phase = Phase::liquid,
           .velocity = {0.1, 0.2, -1.0}});
  lab::jitter(lab, 0.1);
  return lab;
}

struct Drop {
  double light;
  Mode mode;
};
void PrintTo(const Drop& d, std::ostream* out) { *out << 1000.0 / d.light << " " << to_string(d.mode); }
struct TwoLiquids : testing::TestWithParam<Drop> {};

TEST_P(TwoLiquids, KeepMomentumToRoundOffAtAnyDensityRatio) {
  const lab::Lab lab = two_liquids(GetParam().light, GetParam().mode);
  Simulation s(lab.scene, lab.initial);
  const Vec3 before = s.ledger().momentum;
  s.advance_to(0.2);
  EXPECT_GT(s.steps(), 10);
  EXPECT_LT(norm(s.ledger().momentum - before), 1e-13 * motion_of(s));
}
INSTANTIATE_TEST_SUITE_P(Drops, TwoLiquids,
                         testing::Values(Drop{200.0, Mode::corrected}, Drop{1.0, Mode::corrected},
                                         Drop{200.0, Mode::paper}, Drop{1.0, Mode::paper}));

/// A free ball of liquid, radius 5 spacings = 0.5 m, in rigid rotation about an axis that is none of the
/// lattice's.
lab::Lab turning_ball(Mode mode, ViscosityForm form) {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 100.0, 1000.0, mode);
  lab.scene.viscosity_form = form;
  std::vector<Vec3> points;
  for (int z = -5; z <= 5; ++z)
    for (int y = -5; y <= 5; ++y)
      for (int x = -5; x <= 5; ++x)
        if (x * x + y * y + z * z <= 25) points.push_back(0.1 * Vec3{double(x), double(y), double(z)});
  lab.add_points({.name = "ball", .phase = Phase::liquid, .angular_velocity = {0.3, 0.5, 1.0}}, points, 1.0);
  return lab;
}

Vec3 viscous_torque(const Simulation& s) {
  const auto x = lab::positions_by_id(s);
  const auto D = lab::vectors_by_id(s, field::viscous_force);
  Vec3 torque;
  for (std::size_t i = 0; i < x.size(); ++i) torque += cross(x[i], D[i]);
  return torque;
}

TEST(LiquidBall, InRigidRotationFeelsNoCentralViscousTorque) {
  for (const double isotropic : {0.0, 1.0}) {
    lab::Lab lab = turning_ball(Mode::corrected, ViscosityForm::central);
    lab.scene.values["isotropic_shear"] = isotropic;
    const Simulation s(lab.scene, lab.initial);
    // Mu Omega V
    const double scale = 100.0 * norm(Vec3{0.3, 0.5, 1.0}) * static_cast<double>(lab.initial.size()) * 1e-3;
    EXPECT_LT(norm(viscous_torque(s)), 1e-12 * scale) << isotropic;
  }
}

/// Force on the middle of an undisturbed lattice whose velocity along `flow` is u = y^2/2, y along `across`:
/// mu V at unit viscosity.
double force_of_parabola(const Vec3& flow, const Vec3& across, double isotropic) {
  constexpr double dx = 0.1;
  lab::Lab lab = lab::liquid_lab(dx, 1000.0, 1.0, 1000.0, Mode::corrected);
  lab.scene.viscosity_form = ViscosityForm::central;
  lab.scene.values["isotropic_shear"] = isotropic;
  lab.add({.name = "cube", .corner = {0.0, 0.0, 0.0}, .count = {11, 11, 11}, .phase = Phase::liquid});
  const std::size_t middle = 665;
  const Vec3 centre = lab.initial.position[middle];
  for (std::size_t i = 0; i < lab.initial.size(); ++i) {
    const double y = dot(lab.initial.position[i] - centre, across);
    lab.initial.velocity[i] = (0.5 * y * y) * flow;
  }
  const Simulation s(lab.scene, lab.initial);
  return dot(lab::vectors_by_id(s, field::viscous_force)[middle], flow) / (dx * dx * dx);
}

/// The shear moduli of lattice.hpp, of the pair pass itself; what is left is the volume that the kernel's sum
/// over the lattice gives.
TEST(CentralViscosity, ResistsShearAlikeInAllDirectionsOfTheLatticeWithIsotropicShear) {
  const double half = std::sqrt(0.5);
  const Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, up{half, half, 0.0}, down{half, -half, 0.0};
  EXPECT_NEAR(force_of_parabola(x, y, 0.0), 0.887420, 1e-5);
  EXPECT_NEAR(force_of_parabola(up, down, 0.0), 1.168869, 1e-5);
  EXPECT_NEAR(force_of_parabola(x, y, 1.0), 1.0, 1e-9);
  EXPECT_NEAR(force_of_parabola(up, down, 1.0), 1.0, 1e-9);
}

/// (8) brakes it: the torque of its formula, summed with the kernel here and not in the pass.
TEST(LiquidBall, InRigidRotationIsBrakedByThePrintedViscosity) {
  const lab::Lab lab = turning_ball(Mode::paper, ViscosityForm::central);
  const Simulation s(lab.scene, lab.initial);
  const double scale = 100.0 * norm(Vec3{0.3, 0.5, 1.0}) * static_cast<double>(lab.initial.size()) * 1e-3;
  const double torque = dot(viscous_torque(s), (Vec3{0.3, 0.5, 1.0} / norm(Vec3{0.3, 0.5, 1.0}))) / scale;
  EXPECT_NEAR(torque, -2.0, 0.4);
}

TEST(LiquidBall, KeepsAngularMomentumToRoundOffWhileItDisperses) {
  const lab::Lab lab = turning_ball(Mode::corrected, ViscosityForm::central);
  Simulation s(lab.scene, lab.initial);
  const Vec3 before = s.ledger().angular_momentum;
  s.advance_to(2.0);
  EXPECT_GT(s.steps(), 100);
  EXPECT_LT(norm(s.ledger().angular_momentum - before), 1e-12 * norm(before));
}

/// Hot liquid over a fixed floor with a free block in it.
lab::Lab mixed_scene() {
  lab::Lab lab = lab::column(6, 6, 5.0, 1000.0, 10.0);
  const std::size_t wood = lab::add_material_like(lab, 500.0, 0.0);
  const double dx = lab.scene.spacing;
  lab.scene.viscosity_form = ViscosityForm::central;
  lab.add({.name = "block", .material = wood, .corner = {dx, dx, 6.5 * dx}, .count = {3, 3, 3}});
  lab::jitter(lab, 0.1);
  for (const Vec3& r : lab.initial.position) lab.initial.temperature.push_back(300.0 + 10.0 * r.z);
  for (Body& b : lab.scene.bodies) b.temperature.emplace();
  return lab;
}

TEST(Threads, LeaveTheBitsOfLiquidBodiesAndHeatAlone) {
  const lab::Lab lab = mixed_scene();
  Simulation one = lab.run(0.1, 1);
  for (const int threads : {2, 3}) {
    Simulation more = lab.run(0.1, threads);
    EXPECT_EQ(one.steps(), more.steps());
    for (const Field<double>* f : {&field::position.x, &field::velocity.z, &field::pressure,
                                   &field::temperature, &field::viscous_force.x})
      EXPECT_EQ(lab::by_id(one, *f), lab::by_id(more, *f)) << f->name << " with " << threads;
    EXPECT_EQ(one.ledger().energy, more.ledger().energy);
  }
}

}  // namespace
}  // namespace tripoint
