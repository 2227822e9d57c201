// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "effects/fluid_lab.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

double sum_of(const Ledger& ledger) {
  double sum = 0.0;
  for (const auto& [name, value] : ledger.energy) sum += value;
  return sum;
}

/// What became of the energy of a run: all taken at the end, relative to what changed hands.
struct EnergyAccount {
  double exchanged;         ///< greatest change of the kinetic or potential energy on the way [J]
  double residual;          ///< change of the sum of all entries, over `exchanged`
  double time_integration;  ///< greatest on the way, over `exchanged`
};

EnergyAccount account(lab::Lab lab, double time, double step) {
  lab.scene.time_step = step;
  Simulation s(lab.scene, lab.initial);
  const Ledger start = s.ledger();
  EnergyAccount a{};
  double drift = 0.0, scheme = 0.0;
  for (int n = 1; n <= 20; ++n) {
    s.advance_to(time * n / 20);
    const Ledger now = s.ledger();
    for (const char* name : {"kinetic", "potential", "compression"})
      if (now.energy.count(name) > 0)
        a.exchanged = std::max(a.exchanged, std::abs(now.energy.at(name) - start.energy.at(name)));
    drift = std::max(drift, std::abs(sum_of(now) - sum_of(start)));
    scheme = std::max(scheme, std::abs(now.energy.at("time_integration")));
  }
  a.residual = drift / a.exchanged;
  a.time_integration = scheme / a.exchanged;
  return a;
}

/// A column that was set down at rest density and begins to fall into its own weight.
lab::Lab falling_column() { return lab::column(8, 4, 5.0, 1000.0, 10.0); }

lab::Lab floating_block() {
  lab::Lab lab = lab::column(8, 8, 5.0, 1000.0, 10.0);
  const std::size_t wood = lab::add_material_like(lab, 500.0, 0.0);
  const double dx = lab.scene.spacing;
  lab.add({.name = "block", .material = wood, .corner = {2 * dx, 2 * dx, 8.5 * dx}, .count = {4, 4, 4}});
  return lab;
}

lab::Lab head_on_collision() {
  lab::Lab lab = lab::liquid_lab(0.1, 1000.0, 0.0, 400.0);
  lab.scene.materials[0].viscosity = 0.0;
  lab.add({.name = "left", .corner = {-0.55, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {0.5, 0.0, 0.0}});
  lab.add({.name = "right", .corner = {0.25, 0.0, 0.0}, .count = {4, 4, 4}, .velocity = {-0.5, 0.0, 0.0}});
  return lab;
}

/// An elastic cube, turned out of the axes of the liquid that is thrown onto it from all sides.
lab::Lab pressed_cube() {
  const double dx = 0.1;
  lab::Lab lab = lab::liquid_lab(dx, 1000.0, 0.0, 400.0);
  const std::size_t rubber = lab::add_material_like(lab, 1000.0, 0.0);
  lab.scene.materials[rubber].young_modulus = 1e5;
  lab.scene.materials[rubber].poisson_ratio = 0.3;
  lab.scene.materials[rubber].solid = SolidKind::elastic;
  lab.scene.values["face_pressure"] = 1.0;
  lab.scene.values["bulk_viscosity"] = 0.0;
  const Quaternion turn = from_rotation_vector({0.2, 0.5, -0.3});
  std::vector<Vec3> cube, around;
  for (int n = 0; n < 10 * 10 * 10; ++n) {
    const Vec3 r = dx * Vec3{n % 10 - 4.5, n / 10 % 10 - 4.5, n / 100 - 4.5};
    if (std::max({std::abs(r.x), std::abs(r.y), std::abs(r.z)}) < 2.0 * dx)
      cube.push_back(rotate(turn, r));
    else
      around.push_back(r);
  }
  std::erase_if(around, [&](const Vec3& r) {
    return std::ranges::any_of(cube, [&](const Vec3& c) { return norm(r - c) < 0.95 * dx; });
  });
  lab.add_points(
      {.name = "cube", .material = rubber, .phase = Phase::elastic, .angular_velocity = {0.0, 0.0, 1.0}},
      cube, 1000.0 * dx * dx * dx);
  lab.add_points({.name = "water", .phase = Phase::liquid}, around, 1000.0 * dx * dx * dx);
  lab::set_velocity(lab, [](const Vec3& r) { return -2.0 * r; });
  return lab;
}

/// Light liquid falls onto heavy liquid.
lab::Lab layers() {
  lab::Lab lab = lab::column(8, 4, 5.0, 1000.0, 10.0);
  const std::size_t oil = lab::add_material_like(lab, 200.0, 5.0);
  const double dx = lab.scene.spacing;
  lab.add({.name = "oil",
           .material = oil,
           .corner = {0.0, 0.0, 8.5 * dx},
           .count = {4, 4, 4},
           .phase = Phase::liquid});
  lab::jitter(lab, 0.1);
  lab.scene.values["interface_weight"] = 1.0;
  return lab;
}

struct Scene_ {
  const char* name;
  lab::Lab (*make)();
  double time, step;
};
void PrintTo(const Scene_& s, std::ostream* out) { *out << s.name; }
struct FluidLedger : testing::TestWithParam<Scene_> {};

TEST_P(FluidLedger, ClosesToRoundOffAndLeavesToTheSchemeWhatFallsWithTheSquareOfTheStep) {
  const auto& [name, make, time, step] = GetParam();
  const EnergyAccount coarse = account(make(), time, step), fine = account(make(), time, 0.5 * step);
  EXPECT_LT(coarse.residual, 1e-12);
  EXPECT_LT(fine.residual, 1e-12);
  EXPECT_LT(fine.time_integration, 1e-3);
  EXPECT_GT(coarse.time_integration / fine.time_integration, 3.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FluidLedger,
                         testing::Values(Scene_{"column", falling_column, 0.3, 1e-3},
                                         Scene_{"block", floating_block, 0.3, 2e-3},
                                         Scene_{"collision", head_on_collision, 1.0, 1e-3},
                                         Scene_{"cube", pressed_cube, 0.1, 5e-4},
                                         Scene_{"layers", layers, 0.3, 5e-4}),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// Clamped: an unclamped one tears itself apart.
lab::Lab printed_column() {
  lab::Lab lab = lab::column(8, 4, 5.0, 1000.0, 10.0, Mode::paper);
  lab.scene.modes[term::clamp] = Mode::corrected;
  return lab;
}

/// No energy stands behind (7): what it does is accumulated as work, and nothing of it is left to the scheme,
/// however long the step.
TEST(FluidLedger,
     AccumulatesThePrintedPressureAsWorkAndLeavesToTheSchemeOnlyWhatFallsWithTheSquareOfTheStep) {
  const EnergyAccount coarse = account(printed_column(), 0.3, 1e-3),
                      fine = account(printed_column(), 0.3, 5e-4);
  EXPECT_LT(coarse.residual, 1e-12);  // round-off of 300 steps
  EXPECT_LT(fine.residual, 1e-12);
  EXPECT_LT(coarse.time_integration, 1e-3);
  EXPECT_GT(coarse.time_integration / fine.time_integration, 3.0);
  lab::Lab lab = printed_column();
  lab.scene.time_step = 1e-3;
  Simulation s(lab.scene, lab.initial);
  s.advance_to(0.3);
  const Ledger end = s.ledger();
  EXPECT_EQ(end.energy.count("compression"), 0u);
  EXPECT_GT(std::abs(end.energy.at("pressure_work")), 100.0 * std::abs(end.energy.at("time_integration")));
}

TEST(PressedCube, KeepsMomentumAndAngularMomentumToRoundOff) {
  const lab::Lab lab = pressed_cube();
  Simulation start(lab.scene, lab.initial), end = lab.run(0.1);
  double motion = 0.0;
  for (std::size_t i = 0; i < lab.initial.position.size(); ++i)
    motion += lab.initial.mass[i] * norm(lab.initial.velocity[i]);
  EXPECT_GT(norm(end.ledger().momentum - start.ledger().momentum), 0.0);
  EXPECT_LT(norm(end.ledger().momentum - start.ledger().momentum), 1e-12 * motion);
  EXPECT_LT(norm(end.ledger().angular_momentum - start.ledger().angular_momentum), 1e-12 * motion * 0.5);
}

}  // namespace
}  // namespace tripoint
