// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "references/scenes.hpp"
#include "validation/references/cosine_lattice.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/step_images.hpp"
#include "validation/references/two_layers.hpp"

namespace tripoint {
namespace {

using test::pi;
constexpr double D = 2e-6;  // of the bar's material [m2/s]

test::Prepared cosine_bar(int n, bool periodic, double phase) {
  const double dx = 0.1 / n, k = (periodic ? 2.0 : 1.0) * pi / 0.1;
  auto s = test::bar(
      {n, 4, 4}, dx, [&](const Vec3& r) { return 300.0 + 10.0 * std::cos(k * r.x + phase); }, 100.0, 10,
      periodic);
  TemperatureField field;
  field.kind = TemperatureField::Kind::cosine;
  field.mean = 300.0;
  field.amplitude = 10.0;
  field.phase = phase;
  field.wave_vector = {k, 0, 0};
  s.job.scene.bodies[0].temperature = field;
  return s;
}

TEST(CosineMode, SolvesTheHeatEquationByItsOwnDifferences) {
  const auto s = cosine_bar(20, true, 0.7);
  const auto reference = make_reference(test::function("cosine_mode"), s.job, s.initial);
  EXPECT_NEAR(*reference->number("decay_rate"), D * std::pow(2 * pi / 0.1, 2), 1e-15);
  // dT/dt = D d2T/dx2 by central differences of the reference itself: error (k dx)^2/12 = 0.8 % at 20 a
  // wavelength.
  const double h = 0.01, dx = 0.005;
  const auto a = reference->at(50 - h).temperature, b = reference->at(50).temperature,
             c = reference->at(50 + h).temperature;
  const std::size_t i = 16 * 5;
  const double rate = (c[i] - a[i]) / (2 * h), curvature = (b[i + 16] - 2 * b[i] + b[i - 16]) / (dx * dx);
  EXPECT_NEAR(rate / (D * curvature), 1.0, 0.01);
}

TEST(CosineCarried, IsTheStillDecaySeenFromAMovingFrame) {
  const auto s = cosine_bar(20, true, 0.7);
  auto moving = s;
  moving.job.bodies[0].velocity = {0.003, 0, 0};
  const auto still = make_reference(test::function("cosine_mode"), s.job, s.initial);
  const auto carried = make_reference(test::function("cosine_carried"), moving.job, moving.initial);
  const auto a = still->at(40.0), b = carried->at(40.0);
  const double h = 1e-3, k = 2 * pi / 0.1;
  for (const std::size_t i : {0u, 50u, 300u}) {
    EXPECT_EQ(a.temperature[i], b.temperature[i]);
    EXPECT_NEAR(b.position[i].x - s.initial.position[i].x, 0.12, 1e-12);
    // dT/dt + U dT/dx = D d2T/dx2 of the field at a fixed place, by differences in time: (D k^2 h)^2 and
    // round-off below 1e-7.
    const auto field = [&](double x, double t) {
      return 300.0 + 10.0 * std::exp(-D * k * k * t) * std::cos(k * (x - 0.003 * t) + 0.7);
    };
    EXPECT_NEAR(field(b.position[i].x, 40.0), b.temperature[i], 1e-9);
    const double x = b.position[i].x, rate = (field(x, 40 + h) - field(x, 40 - h)) / (2 * h),
                 slope = (field(x + 1e-6, 40) - field(x - 1e-6, 40)) / 2e-6;
    EXPECT_NEAR(rate + 0.003 * slope, -D * k * k * (b.temperature[i] - 300.0), 1e-6);
  }
}

TEST(CosineSum, SolvesTheHeatEquationInAllDirectionsByItsOwnDifferences) {
  const double L = 0.1, W = 0.02, base = 2 * pi;
  const Vec3 k1{base / L, base / W, 0}, k2{2 * base / L, -base / W, base / W};
  const auto start = [&](const Vec3& r) {
    return 300.0 + 10.0 * std::cos(dot(k1, r) + 0.7) + 4.0 * std::cos(dot(k2, r) - 0.4);
  };
  const auto s = test::bar({20, 4, 4}, 0.005, start, 100.0, 10, true);
  auto box = s;
  box.job.scene.min = Vec3{};
  box.job.scene.max = Vec3{L, W, W};
  box.job.scene.periodic = {true, true, true};
  const auto list = [](const Vec3& v) { return std::vector<double>{v.x, v.y, v.z}; };
  Settings args{{"mean", 300.0},  {"amplitude_1", 10.0}, {"wave_vector_1", list(k1)},
                {"phase_1", 0.7}, {"amplitude_2", 4.0},  {"wave_vector_2", list(k2)},
                {"phase_2", -0.4}};
  // Differences need points that lie close: eight particles are moved there. The reference reads places only
  // after it has checked the start.
  const Vec3 r{0.0123, 0.0071, 0.0045};
  const double h = 1e-5, tau = 1e-3, t = 3.0;
  auto near = box;
  const Vec3 around[] = {{}, {h, 0, 0}, {-h, 0, 0}, {0, h, 0}, {0, -h, 0}, {0, 0, h}, {0, 0, -h}};
  for (std::size_t n = 0; n < 7; ++n) {
    near.initial.position[n] = r + around[n];
    near.initial.temperature[n] = start(r + around[n]);
  }
  const auto sum = make_reference(test::function("cosine_sum", args), near.job, near.initial);
  const auto T = sum->at(t).temperature;
  const double laplacian = (T[1] + T[2] + T[3] + T[4] + T[5] + T[6] - 6 * T[0]) / (h * h);
  const double rate = (sum->at(t + tau).temperature[0] - sum->at(t - tau).temperature[0]) / (2 * tau);
  EXPECT_NEAR(rate / (D * laplacian), 1.0, 1e-3);  // (k h)^2/12 and round-off of 300 K over h^2 k^2
  EXPECT_NEAR(*sum->number("diffusivity"), D, 1e-12 * D);
  EXPECT_FALSE(sum->number("mean"));
  args["amplitude_2"] = 5.0;
  EXPECT_THROW((void)make_reference(test::function("cosine_sum", args), box.job, box.initial), InputError)
      << "the scene starts with other waves";
}

TEST(CosineMode, RefusesAWaveThatDoesNotFit) {
  EXPECT_NO_THROW((void)make_reference(test::function("cosine_mode"), cosine_bar(20, false, 0.0).job,
                                       cosine_bar(20, false, 0.0).initial));
  const auto sloped = cosine_bar(20, false, 0.7);
  EXPECT_THROW((void)make_reference(test::function("cosine_mode"), sloped.job, sloped.initial), InputError);
  auto moving = cosine_bar(20, true, 0.7);
  moving.job.bodies[0].velocity = {1, 0, 0};
  EXPECT_THROW((void)make_reference(test::function("cosine_mode"), moving.job, moving.initial), InputError);
}

TEST(SineBetweenHeldEnds, AgreesWithFiniteDifferences) {
  const auto s = cosine_bar(20, false, -pi / 2);
  const auto reference = make_reference(test::function("sine_held_ends"), s.job, s.initial);
  const int n = 200;
  const double dx = 0.1 / n, dt = 0.4 * dx * dx / D, end = 200.0;
  std::vector<double> T(n + 1);
  for (int i = 0; i <= n; ++i) T[i] = 300.0 + 10.0 * std::sin(pi * i / n);
  const int steps = static_cast<int>(std::ceil(end / dt));
  for (int k = 0; k < steps; ++k) {
    std::vector<double> next = T;  // the ends stay
    for (int i = 1; i < n; ++i) next[i] += D * (end / steps) / (dx * dx) * (T[i + 1] - 2.0 * T[i] + T[i - 1]);
    T = next;
  }
  const auto exact = reference->at(end);
  for (std::size_t i = 0; i < s.initial.size(); ++i) {
    const double x = s.initial.position[i].x / dx;
    const int left = static_cast<int>(x);
    // (k dx)^2/12 of 10 K, both ways
    EXPECT_NEAR(exact.temperature[i], T[left] + (x - left) * (T[left + 1] - T[left]), 2e-3);
  }
}

TEST(SineBetweenHeldEnds, RefusesAWaveThatIsNotAtItsMeanAtTheEnds) {
  const auto s = cosine_bar(20, false, 0.0);
  EXPECT_THROW((void)make_reference(test::function("sine_held_ends"), s.job, s.initial), InputError);
}

/// The operator's rate measured on a lattice with particles, not by its eigenvalue formula: dT/dt at one
/// particle.
double measured_paper_damping(int n, double dx, double h) {
  const double k = 2 * pi / (n * dx), mass = 7.0;
  const int reach = 4;
  double rho = 0.0, rate = 0.0;
  const auto visit = [&](auto f) {
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= reach; ++b)
        for (int c = -reach; c <= reach; ++c) {
          const double r = dx * std::sqrt(double(a * a + b * b + c * c));
          if (r < h) f(a * dx, r);
        }
  };
  visit([&](double, double r) {
    rho += mass * 315.0 / (64.0 * pi * std::pow(h, 9)) * std::pow(h * h - r * r, 3);
  });
  const double x = 0.3 / k;
  visit([&](double dxj, double r) {
    rate += mass / rho * (std::cos(k * (x + dxj)) - std::cos(k * x)) * 45.0 / (pi * std::pow(h, 6)) * (h - r);
  });
  return -rate / std::cos(k * x) / (k * k);
}

TEST(CosineModeLattice, IsTheRateOfThePaperOperatorOnTheLattice) {
  // 0.892 0.919 0.926 0.928 at 10/20/40/80 a wavelength, support 2.12 dx: measured with prototypes, three
  // digits.
  const double known[] = {0.892, 0.919, 0.926, 0.928};
  int row = 0;
  for (const int n : {10, 20, 40, 80}) {
    const double dx = 1.0 / n, k = 2 * pi;
    const double ours = paper_lattice_damping({k, 0, 0}, dx, 2.12 * dx) / (k * k);
    EXPECT_NEAR(ours, known[row++], 6e-4) << n;
    EXPECT_NEAR(ours, measured_paper_damping(n, dx, 2.12 * dx), 1e-12) << n;
  }
}

TEST(CosineModeLattice, TendsToTheQuotientOfTheLatticeMoments) {
  // M_lap/S0 at h/dx = 2.12: 0.943/1.015, three digits each.
  EXPECT_NEAR(paper_lattice_damping({1e-3, 0, 0}, 1.0, 2.12) / 1e-6, 0.943 / 1.015, 1e-3);
  EXPECT_NEAR(corrected_lattice_damping({1e-3, 0, 0}, 1.0, 2.6) / 1e-6, 1.0, 1e-6);
}

TEST(CosineModeLattice, HasTheCorrectedFormsKnownErrors) {
  // 4.3 1.1 0.27 0.07 % at 10/20/40/80 (model, 8.6), two digits.
  const double known[] = {0.043, 0.011, 0.0027, 0.0007}, digits[] = {5e-4, 2e-4, 5e-5, 5e-5};
  int row = 0;
  for (const int n : {10, 20, 40, 80}) {
    const double k = 2 * pi / n;
    EXPECT_NEAR(1.0 - corrected_lattice_damping({k, 0, 0}, 1.0, 2.6) / (k * k), known[row], digits[row]) << n;
    ++row;
  }
}

TEST(CosineModeLattice, ServesThePeriodicLatticeOnlyAndTheFormOfTheRun) {
  auto s = cosine_bar(20, true, 0.7);
  s.job.resolution.support_ratio = 2.12;
  s.job.scene.set_all_modes(Mode::paper);
  const double k = 2 * pi / 0.1;
  const auto paper = make_reference(test::function("cosine_mode_lattice"), s.job, s.initial);
  EXPECT_NEAR(*paper->number("decay_rate") / (D * k * k), 0.919, 6e-4);
  const auto corrected = make_reference(
      test::function("cosine_mode_lattice", {{"form", std::string("corrected")}, {"support_ratio", 2.6}}),
      s.job, s.initial);
  EXPECT_NEAR(*corrected->number("decay_rate") / (D * k * k), 0.989, 6e-4);
  s.job.scene.periodic[1] = false;
  EXPECT_THROW((void)make_reference(test::function("cosine_mode_lattice"), s.job, s.initial), InputError);
}

/// Cosine series of an insulated bar, or Fourier series of a periodic one: converges where images are many,
/// and shares nothing with them.
double series_of_step(const StepImages& s, double x, double time) {
  const double L = s.bar.length(), y = x - s.bar.low, a = s.place - s.bar.low;
  double sum = a / L;
  for (int n = 1; n < 4000; ++n) {
    const double k = (s.bar.periodic ? 2.0 : 1.0) * n * pi / L,
                 decay = std::exp(-k * k * s.diffusivity * time);
    const double c = 2.0 * std::sin(k * a) / (k * L),
                 d = s.bar.periodic ? 2.0 * (1.0 - std::cos(k * a)) / (k * L) : 0.0;
    sum += decay * (c * std::cos(k * y) + d * std::sin(k * y));
  }
  return sum;
}

TEST(StepInsulated, EqualsItsEigenfunctionSeriesAtEarlyAndLateTimes) {
  for (const bool periodic : {false, true})
    for (const double time : {1.0, 40.0, 2000.0}) {
      const StepImages s{{0, -0.02, 0.08, periodic}, 0.021, D};
      for (double x = -0.02; x <= 0.0801; x += 0.01)
        EXPECT_NEAR(share_of_low_side(s, x, 0.0, time), series_of_step(s, x, time), 1e-13)
            << x << " at " << time;
    }
}

TEST(StepInsulated, AveragesOverCellsAsAQuadratureDoes) {
  const StepImages s{{0, 0.0, 0.1, false}, 0.05, D};
  for (const double time : {0.0, 3.0}) {
    const double x = 0.0511, cell = 0.01;
    double mean = 0.0;
    const int n = 200000;  // midpoint rule: 1e-11 where smooth, 1/n at the jump
    for (int i = 0; i < n; ++i) mean += share_of_low_side(s, x + cell * ((i + 0.5) / n - 0.5), 0.0, time) / n;
    EXPECT_NEAR(share_of_low_side(s, x, cell, time), mean, time > 0.0 ? 1e-10 : 1e-5);
  }
}

TEST(StepInsulated, TurnsWithTheNormalOfTheStep) {
  auto s = test::bar(
      {20, 2, 2}, 0.005, [](const Vec3& r) { return r.x < 0.05 ? 400.0 : 300.0; }, 10.0, 2, false);
  TemperatureField field;
  field.kind = TemperatureField::Kind::step;
  field.point = {0.05, 0, 0};
  field.normal = {-1, 0, 0};
  field.behind = 300.0;
  field.ahead = 400.0;
  s.job.scene.bodies[0].temperature = field;
  const auto reference = make_reference(test::function("step_insulated"), s.job, s.initial);
  EXPECT_EQ(reference->at(0.0).temperature, s.initial.temperature);
  const auto slower =
      make_reference(test::function("step_insulated", {{"diffusivity", 0.25 * D}}), s.job, s.initial);
  const auto early = reference->at(1.0).temperature,
             late = slower->at(4.0).temperature;  // the ends are not felt yet: the error function
  for (std::size_t i = 0; i < s.initial.size(); ++i) {
    const double expected =
        350.0 - 50.0 * std::erf((s.initial.position[i].x - 0.05) / (2.0 * std::sqrt(D * 1.0)));
    EXPECT_NEAR(early[i], expected, 1e-6);
    EXPECT_NEAR(late[i], early[i], 1e-9);  // of D t alone
  }
  const auto end = reference->at(10.0).temperature;
  EXPECT_GT(end.front(), 399.9);
  double sum = 0.0;
  for (const double T : end) sum += T - 350.0;
  EXPECT_NEAR(sum, 0.0, 1e-9);
}

TEST(TwoConductivities, AgreeAsHalfSpacesAndAsEigenfunctions) {
  // Conductivity ratio 10, equal rho c: contact at 0.7597 of the step (validation notes, 4 digits).
  const TwoLayers s{0.01, 0.05, 0.04, 1e-5, 1e-6, std::sqrt(10.0), 1.0, 1.0, 0.0};
  const TwoLayerSolution solution(s);
  EXPECT_NEAR(solution.half_spaces(0.01, 1.0), 0.7597, 5e-5);
  for (const double x : {-0.03, 0.0, 0.009, 0.01, 0.0105, 0.02, 0.03})
    EXPECT_NEAR(solution.series(x, 0.5), solution.half_spaces(x, 0.5), 1e-12) << x;
}

/// Finite volumes with the exact interface conductance, Crank-Nicolson: nothing in common with the series.
std::vector<double> finite_volumes(const TwoLayers& s, int n, double time, int steps) {
  const double dx = (s.length_low + s.length_high) / n, low_end = s.interface - s.length_low;
  std::vector<double> k(n), c(n), T(n);
  for (int i = 0; i < n; ++i) {
    const bool low = low_end + (i + 0.5) * dx < s.interface;
    k[i] = low ? s.effusivity_low * std::sqrt(s.diffusivity_low)
               : s.effusivity_high * std::sqrt(s.diffusivity_high);
    c[i] = low ? s.effusivity_low / std::sqrt(s.diffusivity_low)
               : s.effusivity_high / std::sqrt(s.diffusivity_high);
    T[i] = low ? s.start_low : s.start_high;
  }
  const auto G = [&](int i) {
    return i < 0 || i + 1 >= n ? 0.0 : 2.0 * k[i] * k[i + 1] / (k[i] + k[i + 1]) / (dx * dx);
  };
  // Four fully implicit quarter steps damp the jump's shortest waves, then Crank-Nicolson (Rannacher 1984).
  const auto step = [&](double dt, double theta) {
    std::vector<double> a(n), b(n), r(n);
    for (int i = 0; i < n; ++i) {
      const double gl = G(i - 1) / c[i] * dt, gr = G(i) / c[i] * dt;
      const double flow = (i > 0 ? gl * (T[i - 1] - T[i]) : 0.0) + (i + 1 < n ? gr * (T[i + 1] - T[i]) : 0.0);
      r[i] = T[i] + (1.0 - theta) * flow;
      const double diagonal = 1.0 + theta * (gl + gr), below = -theta * gl, above = -theta * gr;
      const double m = diagonal - (i > 0 ? below * a[i - 1] : 0.0);
      a[i] = above / m;
      b[i] = (r[i] - (i > 0 ? below * b[i - 1] : 0.0)) / m;
    }
    for (int i = n - 1; i >= 0; --i) T[i] = b[i] - (i + 1 < n ? a[i] * T[i + 1] : 0.0);
  };
  const double dt = time / steps;
  for (int m = 0; m < 4; ++m) step(dt / 4, 1.0);
  for (int m = 1; m < steps; ++m) step(dt, 0.5);
  return T;
}

TEST(TwoConductivities, AgreesWithFiniteVolumesLongAfterTheFrontsReachTheEnds) {
  const TwoLayers s{0.05, 0.05, 0.05, 1e-5, 1e-6, std::sqrt(10.0), 1.0, 1.0, 0.0};
  const int n = 1000;
  const TwoLayerSolution solution(s);
  const auto T = finite_volumes(s, n, 400.0, 2000);
  double worst = 0.0;
  for (int i = 0; i < n; ++i)
    worst = std::max(worst, std::abs(T[i] - solution.at((i + 0.5) * 0.1 / n, 400.0)));
  EXPECT_LT(worst, 2e-6);  // second order in 1/1000
}

TEST(TwoConductivities, TakesLayersFromTheBodies) {
  auto s = test::bar(
      {10, 2, 2}, 0.005, [](const Vec3&) { return 400.0; }, 20.0, 2, false);
  auto cold = s.job.scene.materials[0];
  cold.name = "cold";
  cold.conductivity = 0.2;
  s.job.scene.materials.push_back(cold);
  test::add_body(s, "right", {{10, 2, 2}, 0.005, {0.05, 0, 0}, 1.0}, {});
  s.job.bodies[1].material = "cold";
  s.initial.temperature.resize(s.initial.size(), 300.0);
  const auto reference = make_reference(test::function("two_conductivities"), s.job, s.initial);
  EXPECT_EQ(reference->at(0.0).temperature, s.initial.temperature);
  EXPECT_NEAR(*reference->number("contact_temperature"),
              300.0 + 100.0 * std::sqrt(10.0) / (1.0 + std::sqrt(10.0)), 1e-12);
  EXPECT_LT(reference->at(20.0).temperature[39], 390.0);
  s.job.scene.materials[1].conductivity.reset();
  EXPECT_THROW((void)make_reference(test::function("two_conductivities"), s.job, s.initial), InputError);
}

TEST(References, AreListedWithArgumentsForTheSchema) {
  const auto& list = reference_functions();
  std::set<std::string> names;
  for (const auto& f : list) {
    EXPECT_FALSE(f.source.empty() || f.meaning.empty()) << f.name;
    EXPECT_TRUE(names.insert(f.name).second) << f.name << " is listed twice";
  }
  for (const char* name : {"ballistic", "torque_free", "cosine_mode", "sine_held_ends", "invariant"})
    EXPECT_TRUE(names.count(name)) << name;
}

TEST(Invariant, KnowsNoPositionsSoThatAFrozenRunCannotLookPerfect) {
  const auto s = test::block({1, 2, 3}, 1.0, 2);
  ReferenceChoice choice;
  choice.kind = ReferenceKind::invariant;
  const auto reference = make_reference(choice, s.job, s.initial);
  EXPECT_TRUE(reference->at(1.0).position.empty());
  EXPECT_TRUE(reference->at(1.0).temperature.empty());
  EXPECT_NEAR(reference->at(1.0).total_mass, 1.0, 1e-14);
}

}  // namespace
}  // namespace tripoint
