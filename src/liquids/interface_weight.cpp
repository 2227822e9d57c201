// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/interface_weight.hpp"

#include <cmath>
#include <utility>

#include "liquids/pressing_gravity.hpp"

namespace tripoint::liquid {
namespace {

bool are_unlike(double rest_i, double rest_j) { return rest_i > 0.0 && rest_j > 0.0 && rest_i != rest_j; }

}  // namespace

InterfaceWeight::InterfaceWeight(const Scene& scene, double share) : gravity_(pressing_gravity(scene)) {
  if (share == 0.0 || gravity_ == Vec3{}) return;
  const double dx = scene.spacing, V0 = scene.cell();
  factor_ = 0.5 * share * V0 * V0 / wendland_moments(scene.support_ratio, scene.space()).gradient;
  kernel_ = interface_kernel(scene.support_ratio, scene.space());
  kernel_.square /= dx * dx;
}

void InterfaceWeight::find(const State& state, LiquidDensities rest) {
  if (!pairs_.renew(state.neighbours->rebuilds())) return;
  for (std::uint32_t i = 0; i < state.particles.moving(); ++i) {
    if (rest[i] == 0.0) continue;
    for (const Entry e : state.neighbours->of(i)) {
      const auto j = static_cast<std::uint32_t>(e.row());
      if (are_unlike(rest[i], rest[j])) pairs_.add({j, e.image()});
    }
    if (pairs_.has_open_row()) pairs_.end_row(i);
  }
}

/// The gradient of a (g.d) K: a (g K + (g.d) K'/r d) on i, the opposite on j.
void InterfaceWeight::add_forces(State& state, const PairKernels& kernels, LiquidDensities rest,
                                 const Rows& rows) {
  find(state, rest);
  Particles& p = state.particles;
  const auto x = positions(std::as_const(p));
  const auto F = triple(p, field::force);
  const double support = state.support();
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    if (!rows.has(i)) return;
    Vec3 f;
    for (const ListedPair& pair : pairs_.of(n)) {
      const Vec3 d = way_to(*state.neighbours, x, i, pair);
      const double r = norm(d);
      if (!(r < support)) continue;
      const double a = factor_ * (rest[i] - rest[pair.row]);
      f += (a * kernel_.value(kernels.wendland, r)) * gravity_ +
           (a * dot(gravity_, d) * kernel_.derivative_over_r(kernels.wendland, r)) * d;
    }
    F.set(i, F.at(i) + f);
  });
}

double InterfaceWeight::energy(const PairKernels& kernels, const Vec3& d, double rest_i,
                               double rest_j) const {
  if (!are_unlike(rest_i, rest_j)) return 0.0;
  return factor_ * (rest_i - rest_j) * dot(gravity_, d) * kernel_.value(kernels.wendland, norm(d));
}

double InterfaceWeight::energy(const State& state, const PairKernels& kernels, LiquidDensities rest,
                               std::size_t i) const {
  const auto x = positions(state.particles);
  double sum = 0.0;
  if (rest[i] == 0.0) return sum;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (are_unlike(rest[i], rest[j]))
      sum +=
          0.5 * energy(kernels, (x.at(j) - x.at(i)) + state.neighbours->shift(e.image()), rest[i], rest[j]);
  }
  return sum;
}

}  // namespace tripoint::liquid
