// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/shared_terms.hpp"
#include "sph/lattice.hpp"
#include "step/stability_lab.hpp"

namespace tripoint::stability {
namespace {

using lab::Lab;
/// Calls visit(r, k.r) for the points of the lattice of spacing 1 within q, but the origin.
template <class Visit>
void around(double q, const Vec3& k, Visit visit) {
  const int n = static_cast<int>(std::ceil(q));
  for (int z = -n; z <= n; ++z)
    for (int y = -n; y <= n; ++y)
      for (int x = -n; x <= n; ++x) {
        const Vec3 r{double(x), double(y), double(z)};
        if (norm(r) > 0.0 && norm(r) < q) visit(r, dot(k, r));
      }
}

/// The greatest of f(k) over the waves that the box holds.
template <class F>
double greatest(F f) {
  double most = 0.0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        most = std::max(most, f((2.0 * std::numbers::pi / side) * Vec3{double(x), double(y), double(z)}));
  return most;
}

/// W' of poly6, which the solver needs nowhere.
struct Poly6Slope {
  double h;
  [[nodiscard]] double derivative(double r) const {
    return -6.0 * 315.0 / (64.0 * std::numbers::pi * std::pow(h, 9)) * r * (h * h - r * r) * (h * h - r * r);
  }
};

/// sum W'(r) r/|r| sin(k.r)
template <class Kernel>
Vec3 slope(const Kernel& w, double q, const Vec3& k) {
  Vec3 sum;
  around(q, k,
         [&](const Vec3& r, double kr) { sum += (w.derivative(norm(r)) / norm(r) * std::sin(kr)) * r; });
  return sum;
}

/// The fastest wave of sound that the box holds, spacing 1: omega^2 = k G^2/(S0 M) corrected, k V^2 G_poly6 .
/// G_spiky/2 as printed.
struct Wave {
  Vec3 k, along;
  double limit = 0.0;  ///< 2/omega [s]
};
Wave fastest_wave(Mode mode, double q, double stiffness) {
  Wave wave;
  double most = 0.0;
  greatest([&](const Vec3& k) {
    const LatticeMoments m = wendland_moments(q);
    const double volume = 1.0 / poly6_moments(q).density;
    const Vec3 g = mode == Mode::paper ? slope(Spiky(q), q, k) : slope(WendlandC2(q), q, k);
    const double w2 = mode == Mode::paper
                          ? stiffness * volume * volume * 0.5 * dot(slope(Poly6Slope{q}, q, k), g)
                          : stiffness * dot(g, g) / (m.density * m.gradient);
    if (w2 > most) {
      most = w2;
      wave = {k, g / norm(g), 2.0 / std::sqrt(w2)};
    }
    return w2;
  });
  return wave;
}

/// 2/lambda of the fastest decay [s] of an explicit step: `weight` times sum -W'/r (1 - cos k.r), of r
/// r^T/r^2 where `along`.
double decay_limit(double q, double weight, bool along) {
  const WendlandC2 w(q);
  return 2.0 / greatest([&](const Vec3& k) {
           Symmetric sum;
           around(q, k, [&](const Vec3& r, double kr) {
             const double g = weight * -w.derivative(norm(r)) / norm(r) * (1.0 - std::cos(kr));
             sum = sum + (along ? g / dot(r, r) * square(r) : Symmetric{g, g, g, 0.0, 0.0, 0.0});
           });
           Vec3 v{0.6, 0.5, 0.4};
           double value = 0.0;
           for (int n = 0; n < 60; ++n) {
             const Vec3 next = sum * v;
             value = norm(next);
             if (value == 0.0) break;
             v = next / value;
           }
           return value;
         });
}

Lab sea(Mode mode, double q, double stiffness, double viscosity, double ratio = 1.0) {
  Lab lab = lab::liquid_lab(1.0, 1.0, viscosity, stiffness, mode);
  lab.scene.support_ratio = q;
  lab.scene.modes[term::clamp] = Mode::paper;
  lab.add({.name = "sea", .count = {side, side, side}, .phase = Phase::liquid});
  if (ratio != 1.0) {
    const std::size_t heavy = lab::add_material_like(lab, ratio, viscosity);
    lab.add({.name = "heavy",
             .material = heavy,
             .corner = {0.0, 0.0, double(side)},
             .count = {side, side, side},
             .phase = Phase::liquid});
  }
  lab.make_periodic({true, true, true}, {}, {side, side, ratio != 1.0 ? 2 * side : side});
  if (mode == Mode::paper)
    for (double& m : lab.initial.mass)
      m /= poly6_moments(q).density;  // (4) then reads the rest density on the lattice: no pressure
  return lab;
}

Point sound(Mode mode, const char* parameter, double value, double q, double stiffness, double ratio = 1.0) {
  Lab lab = sea(mode, q, stiffness, 0.0, ratio);
  // One wave alone: on an undisturbed lattice it stays so, and what else the printed form makes grow has no
  // start.
  const Wave wave = fastest_wave(mode, q, stiffness * ratio);
  for (std::size_t i = 0; i < lab.initial.size(); ++i)
    lab.initial.velocity[i] =
        (1e-7 * std::sqrt(stiffness * ratio) * std::cos(dot(wave.k, lab.initial.position[i]))) * wave.along;
  const double first = kinetic(Simulation(lab.scene, lab.initial));
  return {"sound",       std::string(to_string(mode)),    parameter, value, wave.limit,
          own_step(lab), stays(lab, kinetic, 1e3 * first)};
}

Point viscosity(ViscosityForm form, double q) {
  Lab lab = sea(Mode::corrected, q, 1e-8, 1.0);
  lab.scene.viscosity_form = form;
  disturb(lab, 1e-7);
  const bool central = form == ViscosityForm::central;
  const double weight = (central ? 10.0 : 2.0) / wendland_moments(q).gradient;
  // The velocity that viscous pairs see is predicted to the full step by the last forces: then lambda dt < 1
  // is what is stable, not 2.
  return {central ? "viscosity central" : "viscosity laplacian",
          "corrected",
          "h/dx",
          q,
          0.5 * decay_limit(q, weight, central),
          own_step(lab),
          stays(lab, kinetic, kinetic(Simulation(lab.scene, lab.initial)))};
}

Point heat(const char* parameter, double value, double q, double latent) {
  Lab lab(1.0);
  lab.scene.support_ratio = q;
  lab.scene.materials[0].density = lab.scene.materials[0].heat_capacity.emplace(1.0);
  if (latent >= 0.0) {
    lab.scene.materials[0].t_melt = 1000.0;
    lab.scene.materials[0].t_solid = 1000.0;
    lab.scene.materials[0].latent_heat = latent;
    lab.scene.materials[0].viscosity = 0.0;
    lab.scene.materials[0].stiffness = 1e-12;
  }
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  lab.add({.name = "block",
           .count = {side, side, side},
           .motion = Motion::fixed,
           .temperature = [&](const Vec3&) { return 1000.0 + uniform(random); }});
  lab.make_periodic({true, true, true}, {}, {side, side, side});
  const auto spread = [](const Simulation& s) {
    const auto T = s.state().particles[field::temperature];
    return *std::ranges::max_element(T) - *std::ranges::min_element(T);
  };
  // At the lattice the second moments are the gradient moment times the unit matrix: G = V^2 k K/M, K = -2
  // W'/r.
  return {"heat",
          "corrected",
          parameter,
          value,
          decay_limit(q, 2.0 / wendland_moments(q).gradient, false),
          own_step(lab),
          stays(lab, spread, 3.0)};
}

Point elastic(const char* parameter, double value, double young, double poisson) {
  Lab lab = lab::elastic_lab(1.0, poisson);
  lab.scene.materials[0].young_modulus = young;
  lab.add({.count = {4, 4, 4}, .phase = Phase::elastic});
  const double limit = elastic_limit(lab, lab::Deformable(lab));
  disturb(lab, 1e-8 * std::sqrt(young));
  return {"elastic",
          "corrected",
          parameter,
          value,
          limit,
          own_step(lab),
          stays(lab, kinetic, 1e3 * kinetic(Simulation(lab.scene, lab.initial)))};
}

}  // namespace

std::vector<Point> all_points() {
  std::vector<Point> list;
  for (const double k : {1.0, 100.0, 1e4}) list.push_back(sound(Mode::corrected, "stiffness", k, 2.6, k));
  for (const double k : {1.0, 1e4}) list.push_back(sound(Mode::paper, "stiffness", k, 2.12, k));
  for (const double q : {2.2, 2.6, 3.0}) list.push_back(sound(Mode::corrected, "h/dx", q, q, 1.0));
  for (const double q : {2.12, 2.6}) list.push_back(sound(Mode::paper, "h/dx", q, q, 1.0));
  for (const double ratio : {10.0, 1000.0})
    list.push_back(sound(Mode::corrected, "density ratio", ratio, 2.6, 1.0, ratio));
  for (const double q : {2.2, 2.6, 3.0}) list.push_back(viscosity(ViscosityForm::laplacian, q));
  for (const double q : {2.2, 2.6, 3.0}) list.push_back(viscosity(ViscosityForm::central, q));
  for (const double q : {2.2, 2.6, 3.0}) list.push_back(heat("h/dx", q, q, -1.0));
  for (const double L : {0.0, 1.0, 100.0}) list.push_back(heat("latent heat", L, 2.6, L));
  for (const double E : {1.0, 1e4}) list.push_back(elastic("stiffness", E, E, 0.3));
  for (const double nu : {-0.5, 0.0, 0.3, 0.45, 0.499}) list.push_back(elastic("poisson ratio", nu, 1.0, nu));
  add_mixed_points(list);
  add_contact_points(list);
  return list;
}

double frontier(const Point& p) {
  double low = 0.6 * p.predicted, high = p.predicted / 0.6;
  if (!p.stable(low)) return 0.0;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (p.stable(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace tripoint::stability
