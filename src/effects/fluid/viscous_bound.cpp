// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fluid/viscous_bound.hpp"

#include <algorithm>
#include <cmath>

#include "sph/moments.hpp"

#include "effects/fluid/fluid_terms.hpp"

namespace tripoint::fluid {
namespace {

constexpr int rates_between = 32;

/// sum_j of the pair's viscous coefficient, times e e^T for `central` [kg/s]. Plain loops: it runs rarely.
template <class Coefficient>
Symmetric tensor_of(const World& world, const Triple<const double>& x, std::size_t i, bool central, Coefficient coefficient) {
  Symmetric sum;
  const double support2 = world.support() * world.support();
  for (const Entry e : world.neighbours->of(i)) {
    if (e.own()) continue;
    const Vec3 d = (x.at(e.row()) - x.at(i)) + world.neighbours->shift(e.image());
    const double r2 = dot(d, d);
    if (r2 >= support2 || !(r2 > 0.0)) continue;
    const double G = coefficient(e.row(), std::sqrt(r2));
    if (!central) {
      sum.xx += G;
      continue;
    }
    const double g = G / r2;
    sum.xx += g * d.x * d.x, sum.yy += g * d.y * d.y, sum.zz += g * d.z * d.z;
    sum.yz += g * d.y * d.z, sum.xz += g * d.x * d.z, sum.xy += g * d.x * d.y;
  }
  return sum;
}

}  // namespace

void update_viscous_bound(World& world, const PairKernels& kernels) {
  if (world.lagged.viscous_age++ % rates_between != 0) return;
  const Particles& p = world.particles;
  const auto mu = p[field::viscosity], V = p[field::volume], solid = p[field::solid], stick = p[field::stick], group = p[field::group], m = p[field::mass];
  const bool paper = world.scene.mode_of(Term::viscosity) == Mode::paper;
  const bool central = !paper && world.scene.viscosity_form == "central";
  const auto coefficient = [&](std::size_t i, std::size_t j, double r) {
    const double active = acts(group[i], group[j]);
    if (paper) return active * 0.5 * (mu[i] + mu[j]) * V[i] * V[j] * kernels.viscosity.laplacian(r);
    const double pair = active * pair_viscosity(mu[i], solid[i], stick[i], mu[j], solid[j], stick[j]) * -kernels.wendland.derivative_over_r(r) * kernels.per_gradient_moment;
    return central ? 10.0 * V[i] * V[j] * pair : (V[i] * V[i] + V[j] * V[j]) * pair;
  };
  const auto x = positions(p);
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(world.threads) reduction(max : greatest)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (group[i] == 0.0) continue;  // walls do not move by forces
    const Symmetric sum = tensor_of(world, x, i, central, [&](std::size_t j, double r) { return coefficient(i, j, r); });
    greatest = std::max(greatest, (central ? largest_eigenvalue(sum) : sum.xx) / m[i]);
  }
  // Velocities are predicted to the full step by the forces of the last one (predict_velocities), so that a mode of rate lambda is
  // stable while lambda dt < 1, not 2: half of what an explicit step of the same rates bears (model 8.10 counts with 2).
  world.lagged.viscous_step = greatest > 0.0 ? (central ? 0.3 : 0.5) / greatest : std::numeric_limits<double>::infinity();
}

}  // namespace tripoint::fluid
