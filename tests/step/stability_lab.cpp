// SPDX-License-Identifier: BSD-3-Clause
#include "step/stability_lab.hpp"
#include "effects/heat/fields.hpp"
#include "liquids/fields.hpp"

#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "scene/guard_name.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::stability {
namespace {

using lab::Lab;

std::vector<Vec3> random_vectors(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> u(n);
  for (Vec3& x : u) x = {uniform(random), uniform(random), uniform(random)};
  return u;
}

double size_of(const std::vector<Vec3>& u) {
  double sum = 0.0;
  for (const Vec3& x : u) sum += dot(x, x);
  return std::sqrt(sum);
}

/// The growth of one application of a linear map whose values are all of one sign, after so many that only
/// its greatest is left.
template <class Map>
double greatest_value(std::vector<Vec3> u, int times, Map map) {
  double value = 0.0;
  for (int n = 0; n < times; ++n) {
    const double size = size_of(u);
    for (Vec3& x : u) x = x / size;
    u = map(u);
    value = size_of(u);
  }
  return value;
}

/// Gives members of a rigid body the nearest rigid motion; a cube has the same moment about every axis.
void make_rigid(const Lab& lab, bool turns, std::vector<Vec3>& u) {
  const InitialState& s = lab.initial;
  for (int b = 0; b < static_cast<int>(lab.scene.bodies.size()); ++b) {
    double mass = 0.0, moment = 0.0;
    Vec3 centre, P, L;
    const auto each = [&](auto visit) {
      for (std::size_t i = 0; i < u.size(); ++i)
        if (s.body[i] == b) visit(i, s.mass[i]);
    };
    each([&](std::size_t i, double m) {
      mass += m;
      centre += m * s.position[i];
      P += m * u[i];
    });
    if (mass == 0.0) continue;
    centre = centre / mass;
    each([&](std::size_t i, double m) {
      const Vec3 arm = s.position[i] - centre;
      moment += 2.0 / 3.0 * m * dot(arm, arm);
      L += m * cross(arm, u[i]);
    });
    const Vec3 spin = turns && moment > 0.0 ? L / moment : Vec3{};
    each([&](std::size_t i, double) { u[i] = P / mass + cross(spin, s.position[i] - centre); });
  }
}

}  // namespace

void disturb(Lab& lab, double speed) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-speed, speed);
  for (Vec3& v : lab.initial.velocity) v = {uniform(random), uniform(random), uniform(random)};
}

double kinetic(const Simulation& s) {
  double sum = 0.0;
  const Particles& p = s.state().particles;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p[field::mass][i] * dot(p.velocity(i), p.velocity(i));
  return sum;
}

double own_step(const Lab& lab) { return Simulation(lab.scene, lab.initial).bound().dt; }

std::function<bool(double)> stays(Lab lab, std::function<double(const Simulation&)> measure, double most) {
  lab.scene.unguarded = {GuardName::inversion, GuardName::overlap, GuardName::ledger, GuardName::time_step};
  return [lab, measure, most](double dt) {
    Lab here = lab;
    here.scene.time_step = dt;
    try {
      Simulation s(here.scene, here.initial, {.force_time_step = true});
      s.advance_to(double(steps) * dt);
      return measure(s) < most;
    } catch (const Diverged&) {
      return false;
    }
  };
}

double oscillation_limit(const Lab& lab, bool turns) {
  const double e = 1e-6;
  std::vector<Vec3> start = random_vectors(lab.initial.size(), 9);
  make_rigid(lab, turns, start);
  const double w2 = greatest_value(start, 80, [&](const std::vector<Vec3>& u) {
    InitialState moved = lab.initial;
    for (std::size_t i = 0; i < u.size(); ++i) moved.position[i] += e * u[i];
    const Simulation s(lab.scene, moved);
    std::vector<Vec3> a = lab::vectors_by_id(s, field::force);
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = (-1.0 / (e * lab.initial.mass[i])) * a[i];
    make_rigid(lab, turns, a);
    return a;
  });
  return 2.0 / std::sqrt(w2);
}

double conduction_limit(const Lab& lab) {
  std::vector<Vec3> start = random_vectors(lab.initial.size(), 9);
  // Three fields of temperature at once
  return 2.0 / greatest_value(start, 80, [&](const std::vector<Vec3>& u) {
           std::vector<Vec3> rate(u.size());
           for (std::size_t axis = 0; axis < 3; ++axis) {
             InitialState warmed = lab.initial;
             for (std::size_t i = 0; i < u.size(); ++i) warmed.temperature[i] = 1000.0 + u[i][axis];
             const Simulation s(lab.scene, warmed);
             // [K/s]; corrected [W], of particles of 1 J/K
             const bool printed = lab.scene.mode_of(term::heat) == Mode::paper;
             const std::vector<double> rates =
                 lab::by_id(s, printed ? field::temperature_rate : field::heat_rate);
             for (std::size_t i = 0; i < u.size(); ++i) rate[i][axis] = -rates[i];
           }
           return rate;
         });
}

double friction_limit(const Lab& lab) {
  return 2.0 / greatest_value(random_vectors(lab.initial.size(), 9), 80, [&](const std::vector<Vec3>& u) {
           InitialState pushed = lab.initial;
           pushed.velocity = u;
           std::vector<Vec3> a = lab::vectors_by_id(Simulation(lab.scene, pushed), field::viscous_force);
           for (std::size_t i = 0; i < a.size(); ++i) a[i] = (-1.0 / lab.initial.mass[i]) * a[i];
           return a;
         });
}

double elastic_limit(const Lab& lab, lab::Deformable d) {
  const double e = 1e-6;
  std::vector<Vec3> rest(d.size());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = d.force(i);
  const double w2 = greatest_value(random_vectors(d.size(), 9), 150, [&](const std::vector<Vec3>& u) {
    std::size_t at = 0;
    d.place([&](const Vec3& r) { return r + e * u[at++]; });
    std::vector<Vec3> a(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      a[i] = (-1.0 / (e * lab.initial.mass[i])) * (d.force(i) - rest[i]);
    return a;
  });
  return 2.0 / std::sqrt(w2);
}

}  // namespace tripoint::stability
