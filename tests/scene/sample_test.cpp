// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "case_file.hpp"
#include "sampling/lattice.hpp"
#include "sampling/sample.hpp"

namespace tripoint::test {
namespace {

using std::numbers::pi;

Scene scene_of(const std::string& body, const std::string& scene = "") {
  return scene_for(read_text("[scene]\nend_time = 1\nspacing = 0.1\n" + scene +
                             "\n[[material]]\nname='m'\ndensity=1000\nconductivity=1\nheat_capacity=1\n[["
                             "body]]\nname='b'\nmaterial='m'\n" +
                             body)
                       .value,
                   {});
}

/// Moments of a box about its centre.
Vec3 box_inertia(double mass, const Vec3& side) {
  const Vec3 q{side.x * side.x, side.y * side.y, side.z * side.z};
  return (mass / 12.0) * Vec3{q.y + q.z, q.x + q.z, q.x + q.y};
}

TEST(Sample, FillsABoxWithParticlesHalfASpacingInside) {
  for (const double corner : {0.0, 0.3, -0.7, 0.0123, 1e-3, 100.05}) {
    const auto s = sample(scene_of("shape={kind='box',min=[" + std::to_string(corner) + ",0,0],max=[" +
                                   std::to_string(corner + 0.4) + ",0.3,0.2]}"));
    ASSERT_EQ(s.size(), 24U) << corner;
    EXPECT_NEAR(s.position[0].x, corner + 0.05, 1e-12) << corner;
    EXPECT_NEAR(s.position[3].x, corner + 0.35, 1e-12) << corner;
    EXPECT_NEAR(s.position[4].y, 0.15, 1e-12) << "x runs fastest";
    EXPECT_NEAR(s.position[12].z, 0.15, 1e-12) << "z runs slowest";
  }
}

/// A club with a light handle and a heavy head: masses that are a quadratic function of place would be below
/// 0.
TEST(Sample, CarriesGivenMomentsWhereverMassesAboveZeroCan) {
  const std::string club =
      "phase='rigid'\nshape={kind='union',of=[{kind='box',min=[0,0,0],max=[0.2,0.2,1.6]},{kind='box',min=[-0."
      "2,"
      "-0.2,1.6],max=[0.4,0.4,2.0]}]}\n";
  const auto handle = box_inertia(64.0, {0.2, 0.2, 1.6}), head = box_inertia(1440.0, {0.6, 0.6, 0.4});
  const double mass = 64.0 + 1440.0, z = (64.0 * 0.8 + 1440.0 * 1.8) / mass;
  const double arms = 64.0 * (z - 0.8) * (z - 0.8) + 1440.0 * (1.8 - z) * (1.8 - z);
  const Vec3 moments{handle.x + head.x + arms, handle.y + head.y + arms, handle.z + head.z};
  const auto given = [&](double factor) {
    return scene_of(club + fmt::format("mass={}\ncentre=[0.1,0.1,{}]\ninertia=[{},{},{}]", mass, z,
                                       factor * moments.x, factor * moments.y, moments.z));
  };
  const auto s = sample(given(1.0));
  const auto p = mass_properties(s.position, s.mass);
  EXPECT_NEAR(p.mass / mass, 1.0, 1e-9);
  EXPECT_NEAR(p.centre.z, z, 1e-9);
  EXPECT_NEAR(p.principal_inertia.z / moments.y, 1.0, 1e-8);
  for (const double m : s.mass) EXPECT_GT(m, 0.0);
  EXPECT_THROW((void)sample(given(9.0)), InputError);  // farther from the centre than the shape reaches
}

TEST(Sample, LaysNothingWhereRoundOffIsMoreThanThePlaceOfAParticle) {
  const auto at = [](const std::string& x, const std::string& scene = "") {
    try {
      return std::to_string(
          sample(scene_of("shape={kind='box',min=[" + x + ",0,0],max=[" + x + ".4,0.3,0.2]}", scene)).size());
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(at("90000000"), "24");  // 9e8 spacings
  EXPECT_NE(at("110000000").find("1.1e+09 spacings from x = 0 m, where a number cannot tell"),
            std::string::npos)
      << at("110000000");
  const auto wide = at("0", "min=[-1e20,0,0]\nmax=[0.5,1,1]\nperiodic=['x']");
  EXPECT_NE(wide.find("1e+21 spacings from x = -1e+20 m"), std::string::npos) << wide;
}

TEST(Sample, GivesEachParticleTheMassOfItsCell) {
  const auto s = sample(scene_of("shape={kind='box',min=[0,0,0],max=[0.4,0.3,0.2]}"));
  double mass = 0.0;
  for (const double m : s.mass) mass += m;
  EXPECT_NEAR(mass, 24.0, 1e-12);
}

TEST(Sample, LaysASphereSymmetricallyAboutItsCentre) {
  for (const double radius : {0.35, 0.5, 0.52}) {
    const auto s =
        sample(scene_of("shape={kind='sphere',centre=[0.123,-0.4,7],radius=" + std::to_string(radius) + "}"));
    Vec3 mean;
    for (const auto& r : s.position) mean += r;
    EXPECT_LT(norm(mean / static_cast<double>(s.size()) - Vec3{0.123, -0.4, 7}), 1e-13) << radius;
    const auto p = mass_properties(s.position, s.mass);
    EXPECT_NEAR(p.principal_inertia.x / p.principal_inertia.z, 1.0, 1e-12)
        << "a lattice ball has the symmetry of the cube";
  }
}

TEST(Sample, OfASphereTendsToItsVolume) {
  auto scene = scene_of("shape={kind='sphere',centre=[0,0,0],radius=1}");
  scene.spacing = 0.04;
  const double volume = static_cast<double>(sample(scene).size()) * std::pow(scene.spacing, 3);
  EXPECT_NEAR(volume / (4.0 / 3.0 * pi), 1.0,
              5e-3);  // the lattice point discrepancy of a ball of 25 spacings is below dx/R^(3/2)
}

TEST(Sample, OfTouchingBodiesShareOneLattice) {
  const auto s =
      sample(scene_of("shape={kind='box',min=[0.2,0,0],max=[0.5,0.1,0.1]}\n[[body]]\nname='c'\nmaterial='m'"
                      "\nshape={kind='box',"
                      "min=[0.5,0,0],max=[0.9,0.1,0.1]}"));
  ASSERT_EQ(s.size(), 7U);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_NEAR(s.position[i].x - s.position[i - 1].x, 0.1, 1e-15);
  EXPECT_EQ(s.source[2], 0);
  EXPECT_EQ(s.source[3], 1);
}

TEST(Sample, OfAPeriodicDirectionFitsTheDomain) {
  const std::string domain = "min=[-0.33,0,0]\nmax=[0.67,1,1]\nperiodic=['x']";
  const auto s = sample(scene_of("shape={kind='box',min=[-0.33,0,0],max=[0.67,0.1,0.1]}", domain));
  ASSERT_EQ(s.size(), 10U);
  EXPECT_NEAR(s.position[0].x - (-0.33), 0.67 - s.position[9].x, 1e-15);
  EXPECT_THROW(static_cast<void>(sample(scene_of("shape={kind='box',min=[0,0,0],max=[0.55,0.1,0.1]}",
                                                 "min=[0,0,0]\nmax=[0.55,1,1]\nperiodic=['x']"))),
               InputError);
}

TEST(Sample, JitterLeavesABodyThatIsLedWhereItsKeyframesBegin) {
  const auto s =
      sample(scene_of("phase='rigid'\nmotion='prescribed'\nkeyframes=[{time=0,position=[0.2,0.1,0.3]},{time="
                      "1,position=[0.3,0.1,0.3]}]\n"
                      "shape={kind='box',min=[0,0,0],max=[0.4,0.2,0.6]}",
                      "jitter=0.2"));
  Vec3 mean;
  for (const auto& r : s.position) mean += r / static_cast<double>(s.size());
  EXPECT_LT(norm(mean - Vec3{0.2, 0.1, 0.3}), 1e-15);
}

TEST(Sample, ABodyThatDoesNotJitterStaysOnItsLattice) {
  const std::string box = "shape={kind='box',min=[0,0,0],max=[2,2,2]}";
  const auto laid = sample(scene_of(box)), smooth = sample(scene_of(box + "\njitters=false", "jitter=0.2"));
  EXPECT_EQ(smooth.position, laid.position);
}

TEST(Sample, JitterIsBoundedHasNoDriftAndFollowsTheSeed) {
  const std::string box = "shape={kind='box',min=[0,0,0],max=[2,2,2]}";
  const auto a = sample(scene_of(box)), b = sample(scene_of(box, "jitter=0.2")),
             same = sample(scene_of(box, "jitter=0.2")), other = sample(scene_of(box, "jitter=0.2\nseed=2"));
  EXPECT_EQ(b.position, same.position);
  EXPECT_NE(b.position, other.position);
  Vec3 mean;
  double square = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 d = b.position[i] - a.position[i];
    for (std::size_t k = 0; k < 3; ++k) ASSERT_LE(std::abs(d[k]), 0.02);
    mean += d;
    square += dot(d, d) / 3.0;
  }
  const double n = static_cast<double>(a.size()), sigma = 0.02 / std::sqrt(3.0);
  EXPECT_LT(norm(mean / n), 4.0 * sigma * std::sqrt(3.0 / n));  // 4 standard errors
  EXPECT_NEAR(square / n / (sigma * sigma), 1.0,
              4.0 * std::sqrt(0.8 / (3 * n)));  // variance of u^2 of a uniform u is 0.8 sigma^4
}

TEST(Sample, SpinsABodyAboutItsCentreOfMassAndKeepsFixedOnesStill) {
  const auto s = sample(scene_of(
      "velocity=[1,0,0]\nangular_velocity=[0,0,2]\nshape={kind='box',min=[5,5,5],max=[5.4,5.2,5.2]}"));
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vec3 v = Vec3{1, 0, 0} + cross({0, 0, 2}, s.position[i] - Vec3{5.2, 5.1, 5.1});
    EXPECT_LT(norm(s.velocity[i] - v), 1e-13);
  }
  for (const auto& v :
       sample(scene_of("motion='fixed'\nshape={kind='box',min=[0,0,0],max=[0.4,0.2,0.2]}")).velocity)
    EXPECT_EQ(v, (Vec3{}));
}

TEST(Sample, EvaluatesTemperatureFields) {
  const std::string box = "shape={kind='box',min=[0,0,0],max=[1,0.1,0.1]}\n";
  const auto cosine = sample(scene_of(
      box +
      "temperature={kind='cosine',mean=300,amplitude=10,wave_vector=[6.283185307179586,0,0],phase=0.5}"));
  const auto formula =
      sample(scene_of(box + "temperature={kind='expression',value='300 + 10*cos(2*pi*x + 0.5)'}"));
  const auto step =
      sample(scene_of(box + "temperature={kind='step',point=[0.5,0,0],normal=[2,0,0],behind=300,ahead=400}"));
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(cosine.temperature[i],
                300 + 10 * std::cos(2 * pi * (0.1 * static_cast<double>(i) + 0.05) + 0.5), 1e-12);
    EXPECT_NEAR(formula.temperature[i], cosine.temperature[i], 1e-12);
    EXPECT_EQ(step.temperature[i], i < 5 ? 300.0 : 400.0);
  }
  EXPECT_TRUE(sample(scene_of(box)).temperature.empty());
  EXPECT_THROW(
      static_cast<void>(sample(scene_of(box + "temperature={kind='expression',value='300/(x-0.05)'}"))),
      InputError)
      << "not finite at the first particle";
  EXPECT_THROW(static_cast<void>(sample(scene_of(box + "temperature={kind='expression',value='1-x*10'}"))),
               InputError)
      << "below 0 K";
}

TEST(Sample, EvaluatesVelocityFields) {
  const std::string head = "phase='liquid'\nshape={kind='box',min=[0,0,0],max=[0.3,0.2,0.1]}\n";
  const auto linear =
      sample(scene_of(head + "velocity={kind='linear',centre=[0.1,0,0],gradient=[[0,1,0],[2,0,0],[0,0,3]]}"));
  EXPECT_NO_THROW(
      static_cast<void>(sample(scene_of(head + "velocity={kind='expression',value=['0','0','3*z']}"))));
  const auto formula = sample(scene_of(head + "velocity={kind='expression',value=['y','2*(x-0.1)','3*z']}"));
  for (std::size_t i = 0; i < linear.size(); ++i)
    EXPECT_LT(norm(linear.velocity[i] - formula.velocity[i]), 1e-15);
  const auto vortex = sample(scene_of(head + "velocity={kind='taylor_green',speed=2,wavelength=1}"));
  EXPECT_NEAR(vortex.velocity[0].x, -2 * std::cos(2 * pi * 0.05) * std::sin(2 * pi * 0.05), 1e-15);
  EXPECT_NEAR(vortex.velocity[0].y, 2 * std::sin(2 * pi * 0.05) * std::cos(2 * pi * 0.05), 1e-15);
}

TEST(Sample, RefusesBodiesWithoutParticlesOrWithoutEnd) {
  EXPECT_THROW(static_cast<void>(sample(
                   scene_of("shape={kind='sphere',centre=[0.05,0.05,0.05],radius=0.001}\n[[body]]\nname='c'"
                            "\nmaterial='m'\nshape={kind='box',min=[0,0,0],max=[0.01,1,1]}"))),
               InputError);
  EXPECT_THROW(static_cast<void>(sample(scene_of("shape={kind='half_space',point=[0,0,0],normal=[0,0,1]}"))),
               InputError);
  EXPECT_EQ(
      sample(scene_of("shape={kind='half_space',point=[0,0,0.2],normal=[0,0,1]}", "min=[0,0,0]\nmax=[1,1,1]"))
          .size(),
      200U)
      << "a half space fills the domain";
  EXPECT_THROW(static_cast<void>(sample(scene_of("shape={kind='box',min=[0,0,0],max=[1000,1000,1000]}"))),
               InputError)
      << "1e12 cells";
}

TEST(Sample, NumbersSolidBodiesInTheOrderOfTheFile) {
  const auto scene = scene_of(
      "phase='liquid'\nshape={kind='box',min=[0,0,0],max=[0.1,0.1,0.1]}\n[[body]]\nname='c'\nmaterial='m'"
      "\nphase='rigid'\nshape={"
      "kind='box',min=[1,0,0],max=[1.1,0.1,0.1]}");
  EXPECT_EQ(body_rows(scene), (std::vector<int>{-1, 0}));
  const auto s = sample(scene);
  EXPECT_EQ(s.body, (std::vector<int>{-1, 0}));
  EXPECT_EQ(s.phase, (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace tripoint::test
