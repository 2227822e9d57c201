// SPDX-License-Identifier: BSD-3-Clause
#include "effects/viscosity/viscous_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "effects/viscosity/viscous_form.hpp"
#include "liquids/fields.hpp"
#include "pairs/alone.hpp"
#include "sph/moments.hpp"

namespace tripoint::viscosity {
namespace {

/// Rates from one bound to the next: positions change little in so few steps, and the sum costs a pass of its
/// own.
constexpr double rates_between = 32.0;  // [1]

// Velocities are predicted to the full step by the forces of the last one (predict_velocities). A mode of
// rate lambda is then stable while lambda dt < 1, not 2. This is half the limit of an explicit step of the
// same rates (model 8.10). No lambda is above twice the greatest rate of a particle, so 0.5 over that rate is
// enough in both forms. `central` takes less: at 0.3 both forms have 0.46 to 0.62 of the longest stable step,
// as measured (docs/guards.md).
constexpr double share_of_rate = 0.5, share_of_rate_central = 0.3;  // [1]

}  // namespace

void update_viscous_bound(State& state, const PairKernels& kernels) {
  double& age = state.step_numbers[viscous_age];
  const bool is_due = std::fmod(age, rates_between) == 0.0;
  age += 1.0;
  if (!is_due) return;
  const Particles& p = state.particles;
  const ViscousForm form = viscous_form_of(state.scene, kernels);
  const Clusters& c = state.neighbours->clusters();
  ChosenClusters moving{c.listed, {}};
  std::erase_if(moving.clusters, [&](std::uint32_t k) { return c.first[k] >= p.moving(); });
  const PassFunction spread = alone_pass(state, form.spread);
  std::vector<std::vector<double>> sum(spread.adds().size(), std::vector<double>(p.size()));
  add_alone_to(sum, state, spread, kernels, moving);

  const auto group = p[field::group], m = p[field::mass];
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) reduction(max : greatest)
  for (std::size_t i = 0; i < p.moving(); ++i) {
    if (group[i] == 0.0 || !state.owns(i)) continue;  // walls do not move by forces
    const double rate =
        form.central ? largest_eigenvalue({sum[0][i], sum[1][i], sum[2][i], sum[3][i], sum[4][i], sum[5][i]})
                     : sum[0][i];
    greatest = std::max(greatest, rate / m[i]);
  }
  const double share = form.central ? share_of_rate_central : share_of_rate;
  state.step_numbers[viscous_step] =
      greatest > 0.0 ? share / greatest : std::numeric_limits<double>::infinity();
}

}  // namespace tripoint::viscosity
