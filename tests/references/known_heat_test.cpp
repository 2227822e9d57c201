// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions at places and times where their figures can be worked out by hand, and at the edges of what
// they know.
#include <gtest/gtest.h>

#include <cmath>

#include "core/not_a_number.hpp"
#include "references/measured.hpp"
#include "references/melting.hpp"
#include "references/solids.hpp"
#include "validation/references/bar_law.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/neumann.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/solid_scene.hpp"
#include "validation/references/step_images.hpp"

namespace tripoint {
namespace {

using test::pi;
using test::Prepared;

using test::made;

// --- heat

TEST(KnownHeat, EachPhaseHasItsOwnValues) {
  auto s = test::stefan_bar({});
  auto& m = s.job.scene.materials[0];
  m.density = 500.0;
  m.conductivity = 2.0;
  m.heat_capacity = 1000.0;
  m.solid_conductivity = 8.0;
  m.solid_heat_capacity = 250.0;
  EXPECT_EQ(phase_values(s.job, 0, Phase::liquid).conductivity, 2.0);
  EXPECT_EQ(phase_values(s.job, 0, Phase::liquid).heat_per_volume, 5e5);
  for (const auto phase : {Phase::rigid, Phase::elastic}) {
    EXPECT_EQ(phase_values(s.job, 0, phase).conductivity, 8.0);
    EXPECT_EQ(phase_values(s.job, 0, phase).heat_per_volume, 1.25e5);
  }
  EXPECT_NEAR(diffusivity(s.job, 0), 8.0 / 1.25e5, 1e-18);
  EXPECT_NEAR(effusivity(s.job, 0), std::sqrt(8.0 * 1.25e5), 1e-9);
  m.solid_conductivity.reset();
  m.solid_heat_capacity.reset();
  EXPECT_NEAR(diffusivity(s.job, 0), 4e-6, 1e-18);
}

TEST(KnownHeat, ABarEndsWhereItsBodiesDo) {
  auto s = test::bar(
      {4, 2, 2}, 0.1, [](const Vec3&) { return 300.0; }, 1.0, 1, false);
  test::add_body(s, "second", {{2, 2, 2}, 0.1, {0.4, 0, 0}, 1.0}, {});
  const auto both = bar_along(0, s.job, s.initial);
  EXPECT_NEAR(both.low, 0.0, 1e-14);
  EXPECT_NEAR(both.high, 0.6, 1e-14);
  EXPECT_FALSE(both.periodic);
  // No box: the particles and half a spacing
  for (auto& body : s.job.scene.bodies) body.shape.kind = Shape::Kind::sphere;
  EXPECT_NEAR(body_along(0, 1, s.job, s.initial).low, 0.4, 1e-14);
  EXPECT_NEAR(body_along(0, 1, s.job, s.initial).high, 0.6, 1e-14);
  EXPECT_NEAR(body_along(1, 0, s.job, s.initial).length(), 0.2, 1e-14);
  test::close_box(s, {-1, 0, 0}, {2, 1, 1}, {true, false, false});
  EXPECT_TRUE(bar_along(0, s.job, s.initial).periodic);
  EXPECT_EQ(bar_along(0, s.job, s.initial).length(), 3.0);
  for (const auto& [direction, axis] : {std::pair{Vec3{-2, 0, 0}, 0u}, std::pair{Vec3{0, 3, 0}, 1u},
                                        std::pair{Vec3{0, 0, -1}, 2u}, std::pair{Vec3{1, 0, 1e-13}, 0u}})
    EXPECT_EQ(axis_of(direction, "it"), axis);
  for (const Vec3& direction : {Vec3{}, Vec3{1, 1, 0}, Vec3{1, 0, 2e-12}, Vec3{0, 1e-6, 1}})
    EXPECT_THROW((void)axis_of(direction, "it"), InputError);
}

TEST(KnownHeat, AWaveIsMeasuredAlongItsShortestSide) {
  const auto axis = [](const Vec3& waves) {
    auto s = test::bar(
        {4, 4, 4}, 0.1, [](const Vec3&) { return 300.0; }, 1.0, 1, true);
    return made(s, "cosine_mode",
                {{"mean", 300.0},
                 {"amplitude", 1.0},
                 {"wave_vector", std::vector<double>{waves.x * 5 * pi, waves.y * 5 * pi, waves.z * 5 * pi}}})
        ->measuring()
        .axis;
  };
  EXPECT_EQ(axis({2, 1, 1}), 0u);
  EXPECT_EQ(axis({1, -2, 1}), 1u);
  EXPECT_EQ(axis({1, 1, -2}), 2u);
  EXPECT_EQ(axis({1, 1, 1}), 0u);
  EXPECT_EQ(axis({0, 1, 1}), 1u);
}

TEST(KnownHeat, AStepIsSharpAtItsStartAndSharedByItsCell) {
  const StepImages step{{0, 0.0, 1.0, false}, 0.25, 1e-3};
  for (const auto& [x, cell, share] :
       {std::tuple{0.2, 0.0, 1.0}, std::tuple{0.25, 0.0, 0.0}, std::tuple{0.3, 0.0, 0.0},
        std::tuple{0.25, 0.1, 0.5}, std::tuple{0.275, 0.1, 0.25}, std::tuple{0.2, 0.1, 1.0},
        std::tuple{0.3, 0.1, 0.0}})
    EXPECT_NEAR(share_of_low_side(step, x, cell, 0.0), share, 1e-12) << x << " " << cell;
  EXPECT_NEAR(share_of_low_side(step, 0.6, 0.0, 1e4), 0.25, 1e-9);  // even in the end
  EXPECT_NEAR(share_of_low_side(step, 0.25, 0.0, 0.1), 0.5, 1e-9);  // before any end is felt
  const double early = 0.5 * std::erfc(0.05 / std::sqrt(4.0 * 1e-3 * 0.1));
  EXPECT_NEAR(share_of_low_side(step, 0.3, 0.0, 0.1), early, 1e-9);
  const StepImages ring{{0, 0.0, 1.0, true}, 0.25, 1e-3};
  // The second step, at the periodic boundary
  EXPECT_NEAR(share_of_low_side(ring, 0.0, 0.0, 0.1), 0.5, 1e-9);
  EXPECT_NEAR(share_of_low_side(ring, 0.95, 0.0, 0.1), early, 1e-9);
  EXPECT_NEAR(share_of_low_side(step, 0.0, 0.0, 0.1), 1.0, 1e-9);
}

TEST(KnownHeat, TwoLayersAreTheSameInEitherOrder) {
  for (const bool swapped : {false, true}) {
    auto s = test::bar(
        {10, 2, 2}, 0.005, [](const Vec3&) { return 400.0; }, 20.0, 2, false);
    auto cold = s.job.scene.materials[0];
    cold.name = "cold";
    cold.conductivity = 0.2;
    s.job.scene.materials.push_back(cold);
    test::add_body(s, "other", {{10, 2, 2}, 0.005, {swapped ? -0.05 : 0.05, 0, 0}, 1.0}, {});
    s.job.bodies[1].material = "cold";
    s.initial.temperature.resize(s.initial.size(), 300.0);
    const auto contact = made(s, "two_conductivities");
    EXPECT_NEAR(*contact->number("contact_temperature"),
                300.0 + 100.0 * std::sqrt(10.0) / (1.0 + std::sqrt(10.0)), 1e-12);
    const auto T = contact->at(2.0).temperature;
    const double depth = 0.0075, hot = 400.0 + (*contact->number("contact_temperature") - 400.0) *
                                                   std::erfc(depth / std::sqrt(8.0 * 2e-6));
    const std::size_t near = swapped ? 1 * 4 : 8 * 4;  // the second layer from the contact
    EXPECT_NEAR(T[near], hot, 1e-6);
    EXPECT_EQ(contact->at(0.0).temperature, s.initial.temperature);
  }
}

TEST(KnownHeat, AFrontIsAtItsOwnTemperature) {
  const NeumannFront f{400.0, 300.0, 280.0, 2e-6, 50.0, 0.5, 2.0};
  EXPECT_NEAR(f.stefan_number(), 2.0, 1e-14);
  const double X = f.front(7.0);
  EXPECT_NEAR(f.front(28.0), 2.0 * X, 1e-12 * X);
  EXPECT_NEAR(f.temperature(0.0, 7.0), 400.0, 1e-9);
  EXPECT_NEAR(f.temperature(X * (1 - 1e-12), 7.0), 300.0, 1e-6);
  EXPECT_NEAR(f.temperature(X * (1 + 1e-12), 7.0), 300.0, 1e-6);
  EXPECT_NEAR(f.temperature(1.0, 7.0), 280.0, 1e-9);
  // heat in - heat out = heat of the change: -T'(X-) k + 2 k T'(X+) = rho L X', by differences
  const double h = 1e-4 * X, in = (f.temperature(X - h, 7.0) - 300.0) / h,
               out = 2.0 * (300.0 - f.temperature(X + h, 7.0)) / h;
  EXPECT_NEAR((in - out) / (50.0 * (0.5 * X / 7.0) / 2e-6), 1.0, 1e-3);
}

TEST(KnownHeat, AnEventThatOnlyReachesAThresholdChangesNothing) {
  auto s = test::heated_block();
  auto& events = s.job.scene.events;
  events[0].temperature = 300.0;
  events[1].temperature = 300.1;
  events[2].temperature = 290.0;
  events[3].temperature = 289.9;
  const auto loop = made(s, "hysteresis");
  for (const auto& [time, phase] :
       {std::pair{0.5, 1}, std::pair{1.5, 1}, std::pair{2.0, 1}, std::pair{2.5, 0}, std::pair{3.5, 0},
        std::pair{4.0, 0}, std::pair{4.5, 1}}) {
    EXPECT_EQ(loop->at(time).phase[3], phase) << time;
    EXPECT_EQ(loop->at(time).liquid_fraction[3], phase == 0 ? 1.0 : 0.0) << time;
  }
  s.job.scene.materials[0].solid = SolidKind::rigid;
  EXPECT_EQ(made(s, "hysteresis")->at(4.5).phase[0], 2);
  s.job.scene.materials[0].t_solid.reset();
  EXPECT_EQ(made(s, "hysteresis")->at(3.5).phase[0], 2);
}

// --- bars

TEST(KnownBars, TheModulusIsThatOfTheHeldSides) {
  for (const auto& [periodic, modulus] :
       {std::pair{std::array{false, false, false}, 1e7},
        std::pair{std::array{false, true, false}, 1e7 / 0.91},
        std::pair{std::array{false, false, true}, 1e7 / 0.91},
        std::pair{std::array{false, true, true}, 1e7 * 0.7 / (1.3 * 0.4)}}) {
    const auto bar = made(test::driven_bar(1.1, periodic), "tension");
    EXPECT_NEAR(*bar->number("modulus"), modulus, 1e-6);
    EXPECT_NEAR(*bar->number("area"), 0.0016, 1e-15);
    EXPECT_EQ(bar->number("gauge"), 0.5);
    EXPECT_EQ(bar->number("stretch_gauge"), 1.0);
    EXPECT_FALSE(bar->number("yield_stress"));
    EXPECT_FALSE(bar->number("event_time"));
  }
  const auto gauged =
      made(test::driven_bar(1.1), "tension", {{"gauge", 0.25}, {"length", 0.4}, {"area", 2.0}});
  EXPECT_EQ(gauged->number("gauge"), 0.25);
  EXPECT_EQ(gauged->number("stretch_gauge"), 0.25);
  EXPECT_EQ(gauged->number("area"), 2.0);
  EXPECT_NEAR(*gauged->number_at("stretch", 1.0), 1.05, 1e-12);
}

TEST(KnownBars, SidesAreHeldByEachPeriodAcrossTheBar) {
  const auto sides = [](std::array<bool, 3> periodic, std::size_t axis) {
    const auto s = test::driven_bar(1.1, periodic);
    const ReferenceChoice choice;
    const ReferenceFunction function;
    const Arguments none(choice, function);
    return bar_sides({none, s.job, s.initial}, axis);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<bool, 3> one{}, other{}, both{};
    one[(axis + 1) % 3] = other[(axis + 2) % 3] = true;
    both[(axis + 1) % 3] = both[(axis + 2) % 3] = true;
    EXPECT_EQ(sides({}, axis), BarSides::free) << axis;
    EXPECT_EQ(sides(one, axis), BarSides::plane_strain) << axis;
    EXPECT_EQ(sides(other, axis), BarSides::plane_strain) << axis;
    EXPECT_EQ(sides(both, axis), BarSides::confined) << axis;
  }
}

TEST(KnownBars, TheStretchIsThatOfTheKeyframes) {
  auto s = test::driven_bar(1.1);
  const auto bar = made(s, "tension");
  for (const auto& [time, stretch] : {std::pair{0.0, 1.0}, std::pair{0.5, 1.05}, std::pair{1.0, 1.1},
                                      std::pair{1.5, 1.05}, std::pair{2.0, 1.0}, std::pair{5.0, 1.0}}) {
    EXPECT_NEAR(*bar->number_at("stretch", time), stretch, 1e-12) << time;
    const double strain = 0.5 * (stretch * stretch - 1.0);
    EXPECT_NEAR(*bar->number_at("reaction", time), 1e7 * strain * stretch * 0.0016, 1e-6) << time;
    EXPECT_NEAR(bar->at(time).energy.at("elastic"), 0.5 * 1e7 * strain * strain * 0.0016 * 0.2, 1e-8) << time;
  }
  for (auto& key : s.job.bodies[2].keyframes) key.time += 0.5;
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 0.25), 1.0, 1e-12);
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 1.0), 1.05, 1e-12);
  s.job.bodies[2].keyframes.clear();
  s.job.bodies[2].velocity = {0.04, 0, 0};
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 2.0), 1.4, 1e-12);
  s.job.bodies[1].motion = Motion::prescribed;
  s.job.bodies[1].velocity = {-0.02, 0, 0};
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 2.0), 1.6, 1e-12);
  s.job.bodies[2].motion = Motion::fixed;
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 2.0), 1.2, 1e-12);
}

TEST(KnownBars, TearAtTheStretchOfTheirMaterial) {
  auto s = test::driven_bar(1.1);
  s.job.scene.materials[0].fracture_stretch = 1.025;
  const auto torn = made(s, "tension");
  EXPECT_NEAR(*torn->number("event_time"), 0.25, 1e-12);
  EXPECT_NEAR(*torn->number_at("stretch", 0.24), 1.024, 1e-12);
  EXPECT_NEAR(*torn->number_at("stretch", 0.26), 1.0, 1e-9);
  EXPECT_EQ(*torn->number_at("reaction", 0.26), 0.0);
  s.job.scene.materials[0].fracture_stretch = 1.1;
  EXPECT_NEAR(*made(s, "tension")->number("event_time"), 1.0, 1e-9);
  s.job.scene.materials[0].fracture_stretch = 1.101;
  EXPECT_FALSE(made(s, "tension")->number("event_time"));
  s.job.scene.events.resize(2);
  for (std::size_t n = 0; n < 2; ++n) {
    s.job.scene.events[n].kind = Event::Kind::release;
    s.job.scene.events[n].time = 0.75 - 0.25 * static_cast<double>(n);
    s.job.scene.events[n].bodies = {n == 0 ? "held" : "other"};
  }
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 0.6), 1.06, 1e-12);
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 0.8), 1.0, 1e-9);
  s.job.scene.events[1].bodies = {"pulled"};
  EXPECT_NEAR(*made(s, "tension")->number_at("stretch", 0.6), 1.0, 1e-9);
}

TEST(KnownBars, FlowKeepsItsStrainWithinTheLimits) {
  BarLaw law;
  law.young = 1000.0;
  law.poisson_ratio = 0.25;
  law.elastic_limit = 0.01;
  law.plastic_limit = 0.05;
  EXPECT_NEAR(law.yield_stress(), std::sqrt(6.0) * 400.0 * 0.01, 1e-12);
  const double half = std::sqrt(1.5) * 0.01 / 1.25, cap = 0.05 / std::sqrt(1.5);
  for (const double strain : {0.5 * half, 3.0 * half, -3.0 * half, 0.3, -0.3}) {
    const double stretch = std::sqrt(1.0 + 2.0 * strain),
                 plastic = std::abs(strain) <= half
                               ? 0.0
                               : std::copysign(std::min(std::abs(strain) - half, cap), strain);
    const auto s = stretched(law, {}, stretch);
    EXPECT_NEAR(s.plastic, plastic, 1e-14) << strain;
    EXPECT_NEAR(s.force, 1000.0 * (strain - plastic) * stretch, 1e-10) << strain;
    EXPECT_NEAR(s.elastic, 500.0 * (strain - plastic) * (strain - plastic), 1e-10) << strain;
    EXPECT_NEAR(s.dissipated, law.yield_stress() * std::abs(plastic), 1e-12) << strain;
    EXPECT_NEAR(unloaded_stretch(law, s),
                std::sqrt(1.0 + 2.0 * std::clamp(plastic, plastic - half, plastic + half)), 1e-9)
        << strain;
  }
  law.sides = BarSides::confined;
  const double stretch = std::sqrt(1.2), plastic = 2.0 / 3.0 * 0.1 - std::sqrt(2.0 / 3.0) * 0.01;
  const auto held = stretched(law, {}, stretch);
  EXPECT_NEAR(held.plastic, std::min(plastic, cap), 1e-14);
  EXPECT_NEAR(held.force, (1000.0 / 1.5 * 0.1 + 800.0 * (0.2 / 3.0 - held.plastic)) * stretch, 1e-9);
}

// --- tables

TEST(KnownTables, AreReadBetweenTheirRowsAndNotBeyond) {
  const std::string head =
      "# source: a test\n# unit time: 2 s\n# unit a: 10 m\n# uncertainty a: 0.5\n# unit b: 1 m\n# "
      "uncertainty b: 10 %\n";
  const test::DataFile file(test::sealed(head + "time,a,b\n1,1,2\n2,3,-4\n4,3,8\n")),
      one(test::sealed(head + "time,a,b\n1,1,2\n"));
  const auto of = [](const test::DataFile& data, const char* column) {
    const auto s = test::cubes();
    auto choice = test::function("table", {{"column", std::string(column)}});
    choice.file = data.path();
    return make_reference(choice, s.job, s.initial);
  };
  const auto a = of(file, "a"), b = of(file, "b");
  for (const auto& [time, value] : {std::pair{2.0, 10.0}, std::pair{3.0, 20.0}, std::pair{4.0, 30.0},
                                    std::pair{6.0, 30.0}, std::pair{8.0, 30.0}})
    EXPECT_NEAR(*a->number_at("value", time), value, 1e-12) << time;
  EXPECT_FALSE(a->number_at("value", 1.999));
  EXPECT_FALSE(a->number_at("value", 8.001));
  EXPECT_NEAR(*b->number_at("value", 3.0), -1.0, 1e-12);
  EXPECT_NEAR(*a->uncertainty("value", 3.0), 5.0, 1e-12);
  EXPECT_NEAR(*b->uncertainty("value", 2.0), 0.2, 1e-12);
  EXPECT_NEAR(*b->uncertainty("value", 8.0), 0.8, 1e-12);
  EXPECT_NEAR(*b->uncertainty("value", 3.0), 0.3, 1e-12);
  EXPECT_EQ(of(one, "a")->number_at("value", 2.0), 10.0);
  EXPECT_FALSE(of(one, "a")->number_at("value", 2.1));
  EXPECT_NE(a->measured("b"), nullptr);
  EXPECT_EQ(a->measured("c"), nullptr);
}

TEST(KnownTables, AFormulaOfOneComponentLeavesTheOthersAtRest) {
  const auto s = test::cubes();
  for (const std::size_t k : {0u, 1u, 2u}) {
    const std::string name = std::string("velocity_") + "xyz"[k];
    const auto field =
        made(s, "expression", {{name, std::string("2*x + 3*y + t")}, {"density", std::string("5*z")}});
    Snapshot now;
    now.time = 0.5;
    now.position = {{1, 10, 100}, {2, 20, 200}, {not_a_number, 0, 0}};
    const auto truth = field->truth_for(now);
    ASSERT_EQ(truth.velocity.size(), 3u);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(truth.velocity[0][c], c == k ? 32.5 : 0.0) << name;
      EXPECT_EQ(truth.velocity[1][c], c == k ? 64.5 : 0.0) << name;
      EXPECT_TRUE(std::isnan(truth.velocity[2][c])) << name;
    }
    EXPECT_EQ(truth.density, (std::vector<double>{500.0, 1000.0, 0.0}));
    EXPECT_TRUE(truth.temperature.empty() && truth.pressure.empty());
  }
}

}  // namespace
}  // namespace tripoint
