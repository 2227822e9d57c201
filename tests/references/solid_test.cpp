// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "references/solids.hpp"
#include "scene/shared_terms.hpp"
#include "validation/references/bar_law.hpp"
#include "validation/references/beam.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::function;

/// Frequency equation of the clamped-free Timoshenko beam [Huang 1961, J. Appl. Mech. 28]; zero at a root.
double huang(const Beam& b, double w) {
  const double L2 = b.length * b.length, b2 = b.mass * L2 * L2 * w * w / b.bending,
               r2 = b.rotary / (b.mass * L2), s2 = b.bending / (b.shear * L2), k = std::sqrt(b2);
  const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4.0 / b2);
  const double alpha = std::sqrt(0.5 * (root - (r2 + s2))), beta = std::sqrt(0.5 * (root + r2 + s2));
  return 2.0 + (b2 * (r2 - s2) * (r2 - s2) + 2.0) * std::cosh(k * alpha) * std::cos(k * beta) -
         k * (r2 + s2) / std::sqrt(1.0 - b2 * r2 * s2) * std::sinh(k * alpha) * std::sin(k * beta);
}

TEST(Beam, HasTheFrequencyOfHuangsEquation) {
  for (const double height : {0.01, 0.02, 0.06}) {
    const auto b = rectangular_beam(0.2, height, 1.0, 1000.0, 2e6, 0.3975, true, 0.862);
    const double w = beam_frequency(b, {});
    EXPECT_LT(huang(b, w * (1 - 1e-9)) * huang(b, w * (1 + 1e-9)), 0.0) << height;  // bisection to round-off
    EXPECT_GT(huang(b, 0.5 * w) * huang(b, 0.05 * w), 0.0);                         // no root below
  }
}

TEST(Beam, IsTheThinPlateOfGrayMonaghanAndSwift) {
  // L = 0.2, H = 0.02, rho = 1000, E = 2e6, nu = 0.3975: thin plate 0.2541 s, shear and rotary inertia take
  // about 1 % off.
  const auto thin = rectangular_beam(0.2, 0.02, 1.0, 1000.0, 2e6, 0.3975, true, 1e9);
  // As printed
  EXPECT_NEAR(2 * test::pi / beam_frequency({thin.length, thin.bending, 1e12, thin.mass, 0.0}, {}), 0.2541,
              1e-4);
  const auto thick = rectangular_beam(0.2, 0.02, 1.0, 1000.0, 2e6, 0.3975, true,
                                      rectangular_shear_coefficient(0.3975, true));
  EXPECT_NEAR(beam_frequency(thick, {}) / (2 * test::pi) * 0.2541, 0.99, 0.005);
}

TEST(Beam, WithAHeavyTipIsASpring) {
  // Next to no mass of its own
  const auto b = rectangular_beam(0.2, 0.02, 0.02, 1e-3, 2e6, 0.3, false, 0.85);
  const double stiffness = 1.0 / beam_sag(b, {1.0, 0.0, 0.0}, 1.0, b.length).displacement;
  EXPECT_NEAR(beam_frequency(b, {3.0, 0.0, 0.0}), std::sqrt(stiffness / 3.0),
              1e-7 * std::sqrt(stiffness / 3.0));  // the beam weighs 8e-8 kg beside 3 kg
}

TEST(Cantilever, TakesTheBeamFromTheScene) {
  const auto s = test::beam(2.0);
  const auto truth = make_reference(function("cantilever"), s.job, s.initial);
  const double E = 2e6 / (1 - 0.3975 * 0.3975), EI = E * 0.02 * 8e-6 / 12, q = 1000 * 0.02 * 0.02 * 2.0,
               L = 0.2, x = 0.195;
  const double kGA = 10.0 / (12.0 - 0.3975) * 2e6 / (2 * 1.3975) * 4e-4;
  EXPECT_NEAR(*truth->number("deflection"),
              q * x * x * (6 * L * L - 4 * L * x + x * x) / (24 * EI) + q * (L * x - x * x / 2) / kGA, 1e-12);
  EXPECT_EQ(truth->measuring().free_end_is_high, true);
  EXPECT_EQ(truth->measuring().direction->z, -1.0);
  EXPECT_FALSE(truth->number("tip_deflection"));
  const auto weightless = test::beam(0.0);
  const auto free = make_reference(function("cantilever"), weightless.job, weightless.initial);
  EXPECT_FALSE(free->number("deflection"));
  EXPECT_EQ(free->measuring().direction->z, 1.0);  // the thinner side that is not periodic
  EXPECT_EQ(*free->number("frequency"), *truth->number("frequency"));
}

TEST(Cantilever, TakesWhatIsPublishedOfThePlateBeforeTheTheoryOfBeams) {
  const auto s = test::beam(2.0);
  const auto known = make_reference(
      function("cantilever", {{"frequency", 1.0995}, {"deflection", 0.063607}, {"amplitude", 0.06516}}),
      s.job, s.initial);
  EXPECT_NEAR(*known->number("frequency"), 2 * test::pi * 1.0995, 1e-12);
  // Slope at the end of a thin beam under its weight times half a spacing
  const double inside = 1.0 - 4.0 / 3.0 * 0.005 / 0.2;
  // This one is as thick as a tenth of its length
  EXPECT_NEAR(*known->number("deflection"), 0.063607 * inside, 1e-3 * 0.063607);
  EXPECT_NEAR(*known->number("amplitude"), 0.06516 * inside, 1e-3 * 0.06516);
  EXPECT_FALSE(make_reference(function("cantilever"), s.job, s.initial)->number("amplitude"))
      << "a load excites more than the lowest mode";
}

TEST(Cantilever, KnowsTheAmplitudeOfABeamThatStartsInItsLowestMode) {
  auto s = test::beam(0.0);
  for (std::size_t i = 0; i < s.initial.size(); ++i)
    if (s.initial.source[i] == 0) s.initial.velocity[i] = {0, 0, 2.0 * s.initial.position[i].x};
  const auto beam = make_reference(function("cantilever"), s.job, s.initial);
  EXPECT_NEAR(*beam->number("amplitude"), 2.0 * 0.195 / *beam->number("frequency"),
              1e-12);  // the last layer lies half a spacing inside
}

TEST(Cantilever, CarriesARigidTip) {
  const auto s = test::beam(2.0, true);
  const auto truth = make_reference(function("cantilever", {{"tip", std::string("tip")}}), s.job, s.initial);
  const auto bare = make_reference(function("cantilever"), s.job, s.initial);
  EXPECT_LT(*truth->number("frequency"), 0.3 * *bare->number("frequency"));
  EXPECT_GT(*truth->number("tip_deflection"), *truth->number("deflection"));
  EXPECT_GT(*truth->number("deflection"), *bare->number("deflection"));
  EXPECT_THROW(
      (void)make_reference(function("cantilever", {{"tip", std::string("clamp")}}), s.job, s.initial),
      InputError);
}

TEST(BarLaw, IsTheGradientOfItsEnergy) {
  for (const auto sides : {BarSides::free, BarSides::plane_strain, BarSides::confined})
    for (const double form : {0.5, 1.0}) {
      const BarLaw law{1e7, 0.3, sides, 1.0 / 0.0, 1.0 / 0.0, form, form == 0.5 ? 1.0 : 0.9, 1.0};
      const double h = 1e-5, x = 1.07,
                   slope = (stretched(law, {}, x + h).elastic - stretched(law, {}, x - h).elastic) / (2 * h);
      // Second order: h^2 and round-off over h
      EXPECT_NEAR(stretched(law, {}, x).force, slope, 1e-8 * slope);
      EXPECT_NEAR(stretched(law, {}, 1.0 + 1e-7).force / 1e-7, law.modulus(), 1e-6 * law.modulus());
    }
}

TEST(BarLaw, KeepsTheResidualStretchOfTheClosedForm) {
  // E = 1e7, yield at 1e5, stretch 1.03: sqrt(1 + 2 (E_G - sigma_y/E)) = 1.02025, dissipated sigma_y (E_G -
  // sigma_y/E) per volume.
  BarLaw law{1e7, 0.3};
  law.elastic_limit = 1e5 / (std::sqrt(6.0) * 1e7 / 2.6);
  EXPECT_NEAR(law.yield_stress(), 1e5, 1e-9);
  const auto far = stretched(law, {}, 1.03);
  EXPECT_NEAR(unloaded_stretch(law, far), std::sqrt(1 + 2 * (0.03045 - 0.01)), 1e-12);
  EXPECT_NEAR(unloaded_stretch(law, far), 1.02025, 1e-5);
  EXPECT_NEAR(far.dissipated, 1e5 * 0.02045, 1e-9);
  EXPECT_NEAR(far.force, 1.03 * 1e5, 1e-9);
}

TEST(BarLaw, BalancesTheWorkOfACycle) {
  for (const auto sides : {BarSides::free, BarSides::confined}) {
    BarLaw law{1e7, 0.3, sides};
    law.elastic_limit = 0.004;
    BarState s;
    double work = 0.0;
    const int n = 20000;
    for (int i = 1; i <= 4 * n; ++i) {
      const double phase = 0.5 * test::pi * i / n, stretch = 1.0 + 0.03 * std::sin(phase);
      const auto next = stretched(law, s, stretch);
      work += 0.5 * (s.force + next.force) * (next.stretch - s.stretch);
      s = next;
    }
    // The trapezoid's (1/n)^2, the kinks at yield 1/n^2 each
    EXPECT_NEAR(work, s.elastic + s.dissipated, 1e-6 * work);
    EXPECT_GT(s.dissipated, 5.0 * s.elastic);
  }
}

TEST(Tension, PullsByTheKeyframes) {
  const auto s = test::driven_bar(1.02);
  const auto bar = make_reference(function("tension"), s.job, s.initial);
  EXPECT_NEAR(*bar->number_at("stretch", 0.5), 1.01, 1e-12);
  EXPECT_NEAR(*bar->number_at("reaction", 1.0), 1.02 * 1e7 * 0.5 * (1.02 * 1.02 - 1) * 16e-4, 1e-6);
  EXPECT_NEAR(bar->at(1.0).energy.at("elastic"),
              0.5 * 1e7 * std::pow(0.5 * (1.02 * 1.02 - 1), 2) * 16e-4 * 0.2, 1e-9);
  EXPECT_NEAR(*bar->number_at("reaction", 2.0), 0.0, 1e-9);
  EXPECT_FALSE(bar->number("residual_stretch"));
  const auto held = test::driven_bar(1.02, {false, true, false}),
             confined = test::driven_bar(1.02, {false, true, true});
  EXPECT_NEAR(*make_reference(function("tension"), held.job, held.initial)->number("modulus"), 1e7 / 0.91,
              1e-6);
  EXPECT_NEAR(*make_reference(function("tension"), confined.job, confined.initial)->number("modulus"),
              1e7 * 0.7 / (1.3 * 0.4), 1e-6);
}

TEST(Tension, PredictsThePrintedModulus) {
  const auto s = test::driven_bar(1.001);
  const auto bar = make_reference(
      function("tension", {{"form", std::string("paper")}, {"support_ratio", 2.12}}), s.job, s.initial);
  const double M = 0.901, v = 0.947;  // numerics note, three digits
  EXPECT_NEAR(*bar->number("modulus") / (4 * M * M * v * 1e7), 1.0, 2e-3);
}

TEST(Tension, KnowsTheTearAndTheRestAfterARelease) {
  auto s = test::driven_bar(1.1);
  s.job.scene.materials[0].fracture_stretch = 1.04;
  const auto torn = make_reference(function("tension"), s.job, s.initial);
  EXPECT_NEAR(*torn->number("event_time"), 0.4, 1e-12);
  EXPECT_EQ(*torn->number_at("reaction", 0.5), 0.0);
  EXPECT_NEAR(torn->at(0.5).energy.at("elastic"), 0.0, 1e-9);
  s.job.scene.materials[0].fracture_stretch.reset();
  s.job.scene.materials[0].elastic_limit = 0.01;
  Event let_go;
  let_go.kind = Event::Kind::release;
  let_go.time = 1.0;
  let_go.bodies = {"pulled"};
  s.job.scene.events.push_back(let_go);
  const auto kept = make_reference(function("tension"), s.job, s.initial);
  const double yield = 3 * 0.01 / (std::sqrt(6.0) * 1.3);
  EXPECT_NEAR(*kept->number_at("stretch", 1.5), std::sqrt(1 + 2 * (0.5 * (1.21 - 1) - yield)), 1e-9);
  EXPECT_NEAR(*kept->number("residual_stretch"), *kept->number_at("stretch", 1.5), 1e-12);
}

TEST(ElasticWave, HasTheModulusLeftWhenFreeSidesGiveWay) {
  auto s = test::beam(0.0);
  auto& start = s.job.scene.bodies[0].velocity;
  start.kind = VelocityField::Kind::cosine;
  start.amplitude = {0.01, 0, 0};
  start.wave_vector = {10, 0, 0};
  const double E = 2e6, nu = 0.3975, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  // Sides that are held keep their width; the free ones relax until they bear no stress
  for (int held = 0; held <= 2; ++held) {
    double side[2] = {};
    for (int n = 0; n < 400; ++n)
      for (int i = held; i < 2; ++i) side[i] = -lambda * (1.0 + side[1 - i]) / (lambda + 2 * mu);
    const double modulus = lambda * (1.0 + side[0] + side[1]) + 2 * mu;
    s.job.scene.periodic = {true, held > 0, held > 1};
    EXPECT_NEAR(*make_reference(function("elastic_wave"), s.job, s.initial)->number("frequency"),
                10 * std::sqrt(modulus / 1000.0), 1e-6);
  }
}

TEST(ElasticWave, HasTheSpeedsOfTheRodThePlateAndTheBody) {
  auto s = test::beam(0.0);
  auto& start = s.job.scene.bodies[0].velocity;
  start.kind = VelocityField::Kind::cosine;
  start.amplitude = {0.01, 0, 0};
  start.wave_vector = {10, 0, 0};
  const double E = 2e6, nu = 0.3975, rho = 1000.0, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)),
               mu = E / (2 * (1 + nu));
  const auto speed = [&] {
    return *make_reference(function("elastic_wave"), s.job, s.initial)->number("frequency") / 10;
  };
  // a plate: periodic in y
  EXPECT_NEAR(speed(), std::sqrt(4 * mu * (lambda + mu) / (lambda + 2 * mu) / rho), 1e-9);
  s.job.scene.periodic = {true, false, false};
  EXPECT_NEAR(speed(), std::sqrt(E / rho), 1e-9);
  s.job.scene.periodic = {true, true, true};
  EXPECT_NEAR(speed(), std::sqrt((lambda + 2 * mu) / rho), 1e-9);
  start.amplitude = {0, 0, 0.01};
  EXPECT_NEAR(speed(), std::sqrt(mu / rho), 1e-9);
  s.job.scene.modes[term::elastic] = Mode::paper;
  s.job.scene.support_ratio = s.job.resolution.support_ratio = 2.12;
  // Three digits of the numerics note
  EXPECT_NEAR(speed() / std::sqrt(mu / rho), std::sqrt(4 * 0.901 * 0.901 * 0.947), 2e-3);
  start.amplitude = {0.01, 0, 0.01};
  EXPECT_THROW((void)speed(), InputError);
}

}  // namespace
}  // namespace tripoint
