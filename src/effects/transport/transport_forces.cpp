// SPDX-License-Identifier: BSD-3-Clause
#include "effects/transport/transport_forces.hpp"

#include <algorithm>

#include "effects/transport/transport_terms.hpp"
#include "liquids/fields.hpp"
#include "pairs/alone.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::transport {

namespace {

/// From the sums of the pass. Weights and divergence are symmetric in a pair, so that no force of q ever
/// gives energy.
void set_mean_pressure(State& state, const liquid::SceneNumbers& n) {
  Particles& p = state.particles;
  const auto pressure = p[field::pressure], q = p[field::bulk_pressure];
  const auto around = p[field::pressure_around], nearing = p[field::nearing], V = p[field::volume],
             rest = p[field::rest_density], group = p[field::group];
  const double weight = n.mean_pressure * n.rest_volume / n.lattice_density;                       // [m3]
  const double viscosity = n.sound_damping * n.sound_speed * state.support() / n.gradient_moment;  // [m2/s]
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (group[i] != liquid_group) continue;  // walls keep theirs
    pressure[i] += weight * around[i];
    q[i] = viscosity * std::min(rest[i], n.damped_density) * (V[i] * nearing[i]);
  }
}

}  // namespace

void set_transport_forces(State& state, const liquid::SceneNumbers& n, const PairKernels& kernels) {
  Particles& p = state.particles;
  const bool means = liquid::has_transport_means(n);
  const PairTerm term = means ? pair_term<TransportForcesAndMeans> : pair_term<TransportForces>;
  sum_alone(state, term, kernels);
  const double pressure = n.stiffness * n.reference_density;  // rho0 c^2, as Adami, Hu and Adams take it
  const double background = pressure / n.lattice_density, stress = 1.0 / n.lattice_density;
  for (const Field<double>* f : columns_of(field::background))
    for (double& value : p[*f]) value *= background;
  for (const Field<double>* f : columns_of(field::transport_force))
    for (double& value : p[*f]) value *= stress;
  if (means) set_mean_pressure(state, n);
}

void set_shift(State& state, double dt) {
  Particles& p = state.particles;
  const auto w = triple(p, field::shift);
  const auto background = triple(std::as_const(p), field::background);
  const auto m = p[field::mass], group = p[field::group];
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t i = 0; i < p.size(); ++i)
    if (group[i] < 0.0) w.set(i, (0.5 * dt / m[i]) * background.at(i));
}

}  // namespace tripoint::transport
