// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "references/liquids.hpp"
#include "validation/references/elliptic_drop.hpp"
#include "validation/references/plane_shear.hpp"

namespace tripoint {
namespace {

using test::pi;

/// The same flow by implicit finite differences (backward Euler): speeds at the middles of n cells.
std::vector<double> differences(const ShearFlow& f, double time, int n, int steps) {
  const double ds = f.width / n, dt = time / steps, a = f.kinematic_viscosity * dt / (ds * ds);
  const auto count = static_cast<std::size_t>(n);
  std::vector<double> u(count, 0.0), c(count), d(count);
  for (int k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool first = i == 0, last = i + 1 == count;  // walls half a cell away: twice the conductance
      const double low = first ? 2 * a : a, high = last ? 2 * a : a,
                   wall = (first ? low * f.low_speed : 0.0) + (last ? high * f.high_speed : 0.0);
      const double rest = u[i] + dt * f.drive + wall, before = first ? 0.0 : low,
                   pivot = 1 + low + high - (first ? 0.0 : before * c[i - 1]);
      c[i] = (last ? 0.0 : high) / pivot;
      d[i] = (rest + (first ? 0.0 : before * d[i - 1])) / pivot;
    }
    for (std::size_t i = count; i-- > 0;) u[i] = d[i] + (i + 1 < count ? c[i] * u[i + 1] : 0.0);
  }
  return u;
}

TEST(PlaneShear, IsWhatFiniteDifferencesSay) {
  for (const ShearFlow& f : {ShearFlow{1.0, 0.01, 0.08, 0, 0}, ShearFlow{1.0, 0.01, 0.0, 0.0, 1.0},
                             ShearFlow{0.7, 0.02, 0.05, -0.3, 1.0}}) {
    const auto u = differences(f, 10.0, 100, 4000);
    for (const int i : {3, 40, 96})
      EXPECT_NEAR(f.speed((i + 0.5) * f.width / 100, 10.0), u[static_cast<std::size_t>(i)],
                  3e-4);  // cells 1 %, steps 1/4000: both below 3e-4
  }
}

/// The same flow by the method of images [Carslaw & Jaeger 1959, 2.4 and 2.9, where heat is what is momentum
/// here]: it shares no term with the sine series.
double by_images(const ShearFlow& f, double distance, double time) {
  const double reach = 2.0 * std::sqrt(f.kinematic_viscosity * time);
  const auto twice_integrated = [](double x) {
    return 0.25 * ((1.0 + 2.0 * x * x) * std::erfc(x) - 2.0 * x * std::exp(-x * x) / std::sqrt(pi));
  };
  double u = f.drive * time;
  for (int n = 0; n < 40; ++n) {
    const double from_low = (n * f.width + distance) / reach,
                 from_high = ((n + 1) * f.width - distance) / reach, sign = n % 2 == 0 ? 1.0 : -1.0;
    u -= sign * 4.0 * f.drive * time * (twice_integrated(from_low) + twice_integrated(from_high));
    const double below = 2.0 * n * f.width, above = below + 2.0 * f.width;
    u += f.high_speed *
         (std::erfc((below + f.width - distance) / reach) - std::erfc((below + f.width + distance) / reach));
    u += f.low_speed * (std::erfc((below + distance) / reach) - std::erfc((above - distance) / reach));
  }
  return u;
}

TEST(PlaneShear, IsTheSumOfImagesFromEarlyTimesOn) {
  for (const ShearFlow& f :
       // round-off of the sums
       {ShearFlow{1.0, 0.01, 0.08, 0, 0}, ShearFlow{1.0, 0.01, 0.0, 0.0, 1.0},
        ShearFlow{0.7, 0.02, 0.05, -0.3, 1.0}})
    for (const double time : {0.1, 0.5, 2.0, 10.0, 40.0})
      for (const double share : {0.02, 0.21, 0.5, 0.87})
        EXPECT_NEAR(f.speed(share * f.width, time), by_images(f, share * f.width, time), 1e-13) << time;
}

TEST(PlaneShear, TakesTheChannelFromTheScene) {
  const auto s = test::channel({0.08, 0, 0}, {});
  const auto flow = make_reference(test::function("poiseuille"), s.job, s.initial);
  // g s (H - s)/(2 nu), fifth layer
  EXPECT_NEAR(flow->at(1e4).velocity[4].x, 0.08 / 0.02 * 0.45 * 0.55, 1e-9);
  EXPECT_THROW((void)make_reference(test::function("couette"), s.job, s.initial), InputError);
  const auto glide = test::channel({}, {2, 0, 0});
  EXPECT_NEAR(make_reference(test::function("couette"), glide.job, glide.initial)->at(1e4).velocity[9].x, 1.9,
              1e-9);
}

TEST(PlaneShear, JudgesAParticleWhereItIs) {
  const auto s = test::channel({0.08, 0, 0}, {});
  const auto flow = make_reference(test::function("poiseuille"), s.job, s.initial);
  Snapshot now;
  now.time = 1e4;
  now.position = s.initial.position;
  now.position[4].z = 0.25;
  EXPECT_NEAR(flow->truth_for(now).velocity[4].x, 0.08 / 0.02 * 0.25 * 0.75, 1e-9);
}

TEST(Hydrostatic, IsTheIntegralOfTheWeightAbove) {
  const auto s = test::layers(5.0);
  const auto rest = make_reference(test::function("hydrostatic"), s.job, s.initial);
  const auto p = rest->at(0.0).pressure;
  for (const std::size_t i : {0u, 2u, 64u, 67u}) {
    double weight = 0.0;
    const int cells = 80000;
    for (int n = 0; n < cells; ++n) {
      const double z = 0.8 * (n + 0.5) / cells;
      if (z > s.initial.position[i].z) weight += 9.81 * (z < 0.4 ? 1000.0 : 200.0) * 0.8 / cells;
    }
    EXPECT_NEAR(p[i], weight, 0.2);  // a cell of the sum: 9810 x 1e-5
  }
  EXPECT_NEAR(*rest->number("interface_pressure"), 200 * 9.81 * 0.4, 1e-9);
  EXPECT_NEAR(
      make_reference(test::function("hydrostatic", {{"factor", 2.0}}), s.job, s.initial)->at(0.0).pressure[0],
      2 * p[0], 1e-9);
}

TEST(Hydrostatic, OfACompressedLayerHasAllItsWeightAtTheFloorAndTheDensityOfItsPressure) {
  auto s = test::pool(350.0);
  for (Material& m : s.job.scene.materials) m.stiffness = 40.0;  // 8 g H
  const auto truth = make_reference(test::function("hydrostatic", {{"compressed", true}}), s.job, s.initial);
  const auto pressure = [&](double height) {
    Snapshot now;
    now.position = s.initial.position;
    now.position[0].z = height;
    return truth->truth_for(now).pressure[0];
  };
  EXPECT_NEAR(pressure(0.0), 1000.0 * 9.81 * 0.5, 1e-9);
  for (const double z : {0.05, 0.2, 0.4}) {
    const double h = 1e-4, slope = (pressure(z + h) - pressure(z - h)) / (2.0 * h);
    // h^2 g^3/c^4 rho g/6 = 1e-6, and round-off over h
    EXPECT_NEAR(slope, -9.81 * (1000.0 + pressure(z) / 40.0), 1e-3) << z;
  }
  EXPECT_EQ(pressure(0.48), 0.0) << "the surface has fallen by about g H^2/(2 c^2) = 0.03";
}

TEST(Hydrostatic, OfCompressedLayersFallsWithEachDensityAndKeepsTheWeightOfEach) {
  auto s = test::layers(5.0);
  for (Material& m : s.job.scene.materials) m.stiffness = 40.0;
  const auto free = make_reference(test::function("hydrostatic"), s.job, s.initial),
             truth = make_reference(test::function("hydrostatic", {{"compressed", true}}), s.job, s.initial);
  const auto pressure = [&](double height) {
    Snapshot now;
    now.position = s.initial.position;
    now.position[0].z = height;
    return truth->truth_for(now).pressure[0];
  };
  const double at_interface = *free->number("interface_pressure"), interface = *free->number("interface");
  EXPECT_NEAR(pressure(0.0), *free->number("bottom_pressure"), 1e-9);
  EXPECT_EQ(*truth->number("interface"), interface) << "where particles began";
  double low = 0.0, high = interface;  // where the pressure is that of the light layer's weight
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (pressure(middle) > at_interface ? low : high) = middle;
  }
  EXPECT_LT(low, interface);
  const double h = 1e-4;
  const auto slope = [&](double z) { return (pressure(z + h) - pressure(z - h)) / (2.0 * h); };
  for (const double z : {0.1 * low, 0.9 * low})
    EXPECT_NEAR(slope(z), -9.81 * (1000.0 + pressure(z) / 40.0), 1e-3) << z;
  const double c2 = 5.0 * 40.0;  // a light liquid is as hard to compress: k rho_ref/rho0
  for (const double z : {1.1 * low, 1.5 * low})
    EXPECT_NEAR(slope(z), -9.81 * (200.0 + pressure(z) / c2), 1e-3) << z;
}

TEST(Archimedes, IsTheBalanceOfPressureAndWeight) {
  const auto s = test::pool(350.0);
  const auto afloat = make_reference(test::function("archimedes"), s.job, s.initial);
  // Pressure on the keel times its area
  const double lift = 1000.0 * 9.81 * *afloat->number("draught") * 0.16;
  EXPECT_NEAR(lift, s.job.bodies[1].properties.mass * 9.81, 1e-9 * lift);
  auto aside = s;
  for (auto* end : {&aside.job.scene.min, &aside.job.scene.max}) (*end)->x += 0.3;
  const auto beside = make_reference(test::function("archimedes"), aside.job, aside.initial);
  EXPECT_NEAR(*beside->number("pool_area"), *afloat->number("pool_area"), 1e-12)
      << "an area is between two bounds";
  const auto heavy = test::pool(1200.0);
  EXPECT_THROW((void)make_reference(test::function("archimedes"), heavy.job, heavy.initial), InputError);
}

TEST(SoundWave, SolvesTheLinearEquationsByItsOwnDifferences) {
  const auto s = test::swinging(test::sound_start(), 20);
  const auto wave = make_reference(test::function("sound_wave"), s.job, s.initial);
  const double h = 1e-5, rho = 1000.0, c2 = 100.0, t = 0.03;
  Snapshot here;
  here.time = t;
  here.position = s.initial.position;
  const auto at = [&](double dx, double dt) {
    Snapshot now = here;
    now.time += dt;
    now.position[0].x = 0.13 + dx;
    const auto truth = wave->truth_for(now);
    return std::pair{truth.velocity[0].x, truth.pressure[0]};
  };
  const double du_dt = (at(0, h).first - at(0, -h).first) / (2 * h),
               dp_dx = (at(h, 0).second - at(-h, 0).second) / (2 * h);
  const double dp_dt = (at(0, h).second - at(0, -h).second) / (2 * h),
               du_dx = (at(h, 0).first - at(-h, 0).first) / (2 * h);
  EXPECT_NEAR(rho * du_dt, -dp_dx, 1e-5 * std::abs(dp_dx));  // differences of second order: (w h)^2/6
  EXPECT_NEAR(dp_dt, -rho * c2 * du_dx, 1e-5 * std::abs(dp_dt));
}

/// Residual of the x component of Navier-Stokes by differences of the reference itself, its terms of order 1;
/// nu = 0.01 m2/s.
double taylor_green_residual(const test::Prepared& s, const Settings& args) {
  const auto flow = make_reference(test::function("taylor_green", args), s.job, s.initial);
  const auto at = [&](double x, double y, double t) {
    Snapshot now;
    now.time = t;
    now.position = s.initial.position;
    now.position[0] = {x, y, 0};
    const auto truth = flow->truth_for(now);
    return std::pair{truth.velocity[0].x, std::pair{truth.velocity[0].y, truth.pressure[0]}};
  };
  const double x = 0.17, y = 0.31, t = 0.5, h = 1e-4, nu = 0.01;
  const auto u = [&](double dx, double dy, double dt) { return at(x + dx, y + dy, t + dt).first; };
  const auto p = [&](double dx) { return at(x + dx, y, t).second.second; };
  const double w = at(x, y, t).second.first, u0 = u(0, 0, 0);
  const double inertia = (u(0, 0, h) - u(0, 0, -h)) / (2 * h) + u0 * (u(h, 0, 0) - u(-h, 0, 0)) / (2 * h) +
                         w * (u(0, h, 0) - u(0, -h, 0)) / (2 * h);
  const double stress = nu * (u(h, 0, 0) + u(-h, 0, 0) + u(0, h, 0) + u(0, -h, 0) - 4 * u0) / (h * h) -
                        (p(h) - p(-h)) / (2 * h) / 1000.0;
  return inertia - stress;
}

/// A periodic box of liquid that starts with vortices of 1 m and 1 m/s, their pattern begun elsewhere and
/// carried along.
test::Prepared vortices(const Vec3& origin = {}, const Vec3& carried = {}) {
  VelocityField v;
  v.kind = VelocityField::Kind::taylor_green;
  v.speed = 1.0;
  v.wavelength = 1.0;
  auto s = test::swinging(v, 20, 10.0);
  const double k = 2 * pi;
  for (std::size_t i = 0; i < s.initial.size(); ++i) {
    const Vec3 r = s.initial.position[i] - origin;
    s.initial.velocity[i] =
        carried + Vec3{-std::cos(k * r.x) * std::sin(k * r.y), std::sin(k * r.x) * std::cos(k * r.y), 0.0};
  }
  return s;
}

TEST(TaylorGreen, SolvesNavierStokesByItsOwnDifferences) {
  // Of terms of order 1: (k h)^2/6 and round-off over h^2
  EXPECT_NEAR(taylor_green_residual(vortices(), {}), 0.0, 1e-5);
}

TEST(TaylorGreen, SolvesNavierStokesAlsoShiftedAndCarriedAlong) {
  const Vec3 origin{0.13, 0.29, 0}, carried{0.7, -0.4, 0.2};
  const Settings args{{"origin", std::vector<double>{0.13, 0.29, 0}},
                      {"carried", std::vector<double>{0.7, -0.4, 0.2}}};
  EXPECT_NEAR(taylor_green_residual(vortices(origin, carried), args), 0.0, 1e-5);
  EXPECT_THROW((void)taylor_green_residual(vortices(), args), InputError)
      << "the liquid starts with other vortices than the arguments name";
}

TEST(CouetteCylinders, BalancesTheTorqueBetweenAnyTwoRadiiAndSticksToBothWalls) {
  auto s = test::channel({}, {});
  const double a = 0.2, b = 0.5, spin = 3.0, mu = 10.0;
  s.job.bodies[1].motion = Motion::prescribed;
  s.job.bodies[1].angular_velocity = {0, 0, spin};
  s.job.scene.periodic = {false, false, true};
  const auto flow = make_reference(
      test::function("couette_cylinders",
                     {{"inner_radius", a}, {"outer_radius", b}, {"body", std::string("lower")}}),
      s.job, s.initial);
  const Vec3 centre = s.job.bodies[1].properties.centre;
  const auto speed = [&](double r) {
    Snapshot now;
    now.position = s.initial.position;
    now.position[0] = centre + r * Vec3{0.6, 0.8, 0.0};
    return dot(flow->truth_for(now).velocity[0], Vec3{-0.8, 0.6, 0.0});
  };
  EXPECT_NEAR(speed(a), spin * a, 1e-12);
  EXPECT_NEAR(speed(b), 0.0, 1e-12);
  const double height = s.job.scene.max->z - s.job.scene.min->z, h = 1e-4;
  // The torque of shear r d(u/r)/dr over a cylinder is the same at every radius
  for (const double r : {0.22, 0.3, 0.41}) {
    const double rate = r * (speed(r + h) / (r + h) - speed(r - h) / (r - h)) / (2 * h);
    EXPECT_NEAR(mu * rate * 2 * pi * r * r * height / *flow->number("torque"), 1.0, 1e-6);  // (h/r)^2
  }
}

TEST(EllipticDrop, KeepsItsEnergyAndVolume) {
  const double A = 100.0, R = 1.0;
  for (const double t : {0.002, 0.0076, 0.02}) {
    const auto s = elliptic_drop(A, R, t);
    EXPECT_NEAR(s.rate * s.rate * (s.a * s.a + s.b * s.b), 2 * A * A * R * R,
                1e-8 * A * A);  // no work is done: the surface is free
    EXPECT_NEAR(s.a * s.b, R * R, 1e-12);
  }
  // Monaghan 1994: b = 1.95 at t = 0.0076, two digits
  EXPECT_NEAR(elliptic_drop(A, R, 0.0076).b, 1.95, 0.02);
}

TEST(AddedMass, IsTheEnergyOfTheDipoleAroundTheSphere) {
  // 1/2 rho int |u|^2 outside, u = grad of U R^3 cos/(2 r^2): |u|^2 = (R/r)^6 (cos^2 + sin^2/4)
  double energy = 0.0;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double q = (i + 0.5) / n, c = -1 + 2 * (j + 0.5) / n;  // q = R/r
      energy += 0.5 * std::pow(q, 6) * (c * c + 0.25 * (1 - c * c)) * 2 * pi / std::pow(q, 4) / n * 2 / n;
    }
  EXPECT_NEAR(energy / (0.5 * 4.0 / 3.0 * pi), 0.5, 1e-5);
  auto s = test::pool(500.0);
  s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
  EXPECT_NEAR(*make_reference(test::function("added_mass"), s.job, s.initial)->number("acceleration"),
              0.5 * 9.81, 1e-12);
}

TEST(AddedMass, TakesLiquidInLayersOfOneDensityOnly) {
  const auto layered = [](double density) {
    auto s = test::pool(500.0);
    s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
    test::add_matter(s, "second", Phase::liquid, {{10, 10, 2}, 0.1, {0, 0, 1.5}, 1.0}, {}, density);
    return s;
  };
  const auto same = layered(1000.0), other = layered(900.0);
  EXPECT_NEAR(*make_reference(test::function("added_mass"), same.job, same.initial)->number("acceleration"),
              0.5 * 9.81, 1e-12);
  EXPECT_THROW((void)make_reference(test::function("added_mass"), other.job, other.initial), InputError);
}

/// Spheres in a square array move as each other's wall: the backflow of the dipoles beside one, -R^3/2 sum
/// 1/r^3, raises its added mass by 3/2 of it.
TEST(AddedMass, OfASquareArrayIsThatOfAWallAtTheDistanceOfItsLatticeSum) {
  double sum = 0.0;  // the rest beyond n is 2 pi/n by an integral
  const int n = 400;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      if (const double r2 = i * i + j * j; r2 > 0.0 && r2 <= n * n) sum += std::pow(r2, -1.5);
  sum += 2.0 * pi / n;
  const double spacing = 5.0, backflow = 0.5 * sum / std::pow(spacing, 3);  // of the speed, at 5 radii apart
  auto s = test::pool(500.0);
  s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
  const double a =
      *make_reference(test::function("added_mass", {{"radius_over_wall", 0.3306}}), s.job, s.initial)
           ->number("acceleration");
  EXPECT_NEAR(a, 0.5 * 9.81 / (0.5 + 0.5 * (1.0 + 3.0 * backflow)), 1e-4 * 9.81);  // four digits of 0.3306
}

TEST(ElasticCollision, KeepsMomentumAndEnergyOfUnequalBodies) {
  const auto s = test::cubes();
  const auto hit = make_reference(test::function("elastic_collision"), s.job, s.initial);
  const auto before = hit->at(0.0).bodies, after = hit->at(0.5).bodies;
  double momentum = 0.0, energy = 0.0;
  for (std::size_t b = 0; b < 2; ++b) {
    momentum += after[b].mass * (after[b].velocity.x - before[b].velocity.x);
    energy += after[b].mass * (std::pow(after[b].velocity.x, 2) - std::pow(before[b].velocity.x, 2));
  }
  EXPECT_NEAR(momentum, 0.0, 1e-12);
  EXPECT_NEAR(energy, 0.0, 1e-12);
  EXPECT_NEAR(*hit->number("touch_time"), 0.4 / 1.5, 1e-12);
  EXPECT_LT(after[0].velocity.x, after[1].velocity.x);
}

TEST(ElasticCollision, CarriesTheParticlesOfEachBodyWithIt) {
  const auto s = test::cubes();
  const auto hit = make_reference(test::function("elastic_collision"), s.job, s.initial);
  for (const double time : {0.0, 0.1, 0.5}) {  // before the touch and after it
    const auto frame = hit->at(time);
    ASSERT_EQ(frame.position.size(), s.initial.size());
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
      const auto b = static_cast<std::size_t>(s.initial.source[i]);
      const Vec3 way = frame.bodies[b].position - s.job.bodies[b].properties.centre;
      EXPECT_LT(norm(frame.position[i] - s.initial.position[i] - way), 1e-12);
    }
  }
}

TEST(Bouncing, IsTheFallStepByStepWithTheHitsTurnedRound) {
  auto s = test::cubes();
  s.job.scene.gravity = {-9.81, 0, 0};
  s.job.bodies[0].motion = Motion::fixed;
  s.job.bodies[1].velocity = {};
  const double gap = 0.4, dt = 1e-5;
  for (const double e : {1.0, 0.5}) {
    const auto bounce = make_reference(test::function("bouncing", {{"restitution", e}}), s.job, s.initial);
    double z = gap, v = 0.0, t = 0.0;
    const double rest = bounce->at(0.0).bodies[1].position.x - gap;
    for (int n = 1; n <= 200000; ++n) {
      z += v * dt - 0.5 * 9.81 * dt * dt;
      v -= 9.81 * dt;
      t += dt;
      if (z < 0.0 && v < 0.0) {
        z = -e * z;
        v = -e * v;
      }
      if (n % 20000 != 0 || (e < 1.0 && t > 0.8)) continue;
      // Three hits, each seen up to a step late: v dt of place, and 2 v dt of later times
      EXPECT_NEAR(bounce->at(t).bodies[1].position.x - rest, z, 5e-4) << e << " at " << t;
    }
    EXPECT_NEAR(*bounce->number("touch_time"), std::sqrt(2 * gap / 9.81), 1e-12);
  }
  const auto dead =
      make_reference(test::function("bouncing", {{"restitution", 0.5}}), s.job, s.initial)->at(5.0).bodies[1];
  EXPECT_EQ(dead.velocity.x, 0.0) << "hits without end come to rest in finite time, at 3 first falls";
}

TEST(LiquidBall, BrakesByThePrintedFormAsItsPairSumSays) {
  // Torque of (8) on a homogeneous ball in rigid rotation: 1/2 mu int int lapW(r) |w x r|^2 = 1/2 mu V w^2
  // (2/3) int lapW r^2.
  const double h = 0.2, R = 0.5, nu = 0.005;
  double moment = 0.0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double r = h * (i + 0.5) / n;
    moment += 4 * pi * r * r * 45.0 / (pi * std::pow(h, 6)) * (h - r) * r * r * h / n;
  }
  const double rate = 0.5 * nu * (2.0 / 3.0) * moment / (0.4 * R * R);
  test::Prepared s;
  s.job.scene.spacing = 0.1;
  test::add_matter(s, "ball", Phase::liquid, {{4, 4, 4}, 0.1, {}, 1.0}, {}, 1000.0, 5.0);
  s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere;
  s.job.scene.bodies[0].shape.radius = R;
  s.job.scene.bodies[0].angular_velocity = {0, 0, 1};
  const auto ball =
      make_reference(test::function("liquid_ball", {{"form", std::string("paper")}}), s.job, s.initial);
  EXPECT_NEAR(*ball->number("spin_rate"), rate, 1e-5 * rate);
  EXPECT_EQ(*make_reference(test::function("liquid_ball"), s.job, s.initial)->number("spin_rate"), 0.0);
}

}  // namespace
}  // namespace tripoint
