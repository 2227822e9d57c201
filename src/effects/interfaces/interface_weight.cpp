// SPDX-License-Identifier: BSD-3-Clause
#include "effects/interfaces/interface_weight.hpp"

#include <cmath>
#include <utility>

#include "liquids/fields.hpp"
#include "liquids/pressing_gravity.hpp"
#include "scene/effect_rule.hpp"

namespace tripoint::interfaces {
namespace {

bool are_unlike(double group_i, double rest_i, double group_j, double rest_j) {
  return group_i == liquid_group && group_j == liquid_group && rest_i != rest_j;
}

}  // namespace

InterfaceWeight::InterfaceWeight(const Scene& scene) : gravity_(liquid::pressing_gravity(scene)) {
  const double share = acting_number(scene, "interface_weight");
  if (share == 0.0) return;
  const double dx = scene.spacing, V0 = scene.cell();
  factor_ = 0.5 * share * V0 * V0 / wendland_moments(scene.support_ratio, scene.space()).gradient;
  kernel_ = interface_kernel(scene.support_ratio, scene.space());
  kernel_.square /= dx * dx;
}

void InterfaceWeight::find(const State& state) {
  if (!pairs_.renew(state.neighbours->rebuilds())) return;
  const Particles& p = state.particles;
  const auto group = p[field::group], rest = p[field::rest_density];
  for (std::uint32_t i = 0; i < p.moving(); ++i) {
    if (group[i] != liquid_group) continue;
    for (const Entry e : state.neighbours->of(i)) {
      const auto j = static_cast<std::uint32_t>(e.row());
      if (are_unlike(group[i], rest[i], group[j], rest[j])) pairs_.add({j, e.image()});
    }
    if (pairs_.has_open_row()) pairs_.end_row(i);
  }
}

/// The gradient of a (g.d) K: a (g K + (g.d) K'/r d) on i, the opposite on j.
void InterfaceWeight::add_forces(State& state, const PairKernels& kernels, const Rows& rows) {
  find(state);
  Particles& p = state.particles;
  const auto x = positions(std::as_const(p));
  const auto rest = std::as_const(p)[field::rest_density];
  const auto F = triple(p, field::force);
  const double support = state.support();
  pairs_.each_row(state.threads, [&](std::size_t n) {
    const std::size_t i = pairs_.row(n);
    if (!rows.has(i)) return;
    Vec3 f;
    for (const liquid::ListedPair& pair : pairs_.of(n)) {
      const Vec3 d = liquid::way_to(*state.neighbours, x, i, pair);
      const double r = norm(d);
      if (!(r < support)) continue;
      const double a = factor_ * (rest[i] - rest[pair.row]);
      f += (a * kernel_.value(kernels.wendland, r)) * gravity_ +
           (a * dot(gravity_, d) * kernel_.derivative_over_r(kernels.wendland, r)) * d;
    }
    F.set(i, F.at(i) + f);
  });
}

double InterfaceWeight::energy(const State& state, const PairKernels& kernels, std::size_t i) const {
  const Particles& p = state.particles;
  const auto group = p[field::group], rest = p[field::rest_density];
  const auto x = positions(p);
  double sum = 0.0;
  if (group[i] != liquid_group) return sum;
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (!are_unlike(group[i], rest[i], group[j], rest[j])) continue;
    const Vec3 d = (x.at(j) - x.at(i)) + state.neighbours->shift(e.image());
    const double r = norm(d);
    if (r < state.support())
      sum += 0.5 * factor_ * (rest[i] - rest[j]) * dot(gravity_, d) * kernel_.value(kernels.wendland, r);
  }
  return sum;
}

}  // namespace tripoint::interfaces
