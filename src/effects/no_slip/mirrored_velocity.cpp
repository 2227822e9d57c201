// SPDX-License-Identifier: BSD-3-Clause
#include "effects/no_slip/mirrored_velocity.hpp"

#include "effects/no_slip/wall_terms.hpp"
#include "liquids/fields.hpp"
#include "liquids/fixed_walls.hpp"
#include "pairs/alone.hpp"
#include "state/fill.hpp"

namespace tripoint::no_slip {

/// Finds the walls with liquid in reach, anew after each rebuild of the lists. The viscous velocities of
/// fixed walls, which only wet ones are given, become 0 again.
void MirroredVelocity::find(State& state, const Rows& rows) {
  if (known_ == state.neighbours->rebuilds()) return;
  known_ = state.neighbours->rebuilds();
  wet_walls_.clear();
  const Particles& p = state.particles;
  for (const Field<double>* f : columns_of(field::viscous_velocity))
    fill(part(state.particles[*f], {p.moving(), rows.to}), 0.0, state.threads);
  const auto group = state.particles[field::group];
  const auto stick = state.particles[field::stick];
  const bool drags = liquid::all_drag(state.scene);
  const Clusters& c = state.neighbours->clusters();
  for (const std::size_t k : c.listed) {
    unsigned walls = 0, wet = 0;  // bits of members
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      walls |= static_cast<unsigned>(group[i] == wall_group && (drags || stick[i] != 0.0))
               << (i - c.first[k]);
    for (std::size_t e = c.start[k]; e < c.start[k + 1] && (walls & ~wet) != 0; ++e)
      if (group[Entry{c.entries[e]}.row()] == liquid_group) wet |= c.near[e];
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      if ((walls & wet) >> (i - c.first[k]) & 1u) wet_walls_.push_back(i);
  }
  wet_ = clusters_of(c, wet_walls_);
}

void MirroredVelocity::mirror(State& state, const PairKernels& kernels, const Rows& rows) {
  find(state, rows);
  Particles& p = state.particles;
  for (const Field<double>* f : WallExtrapolation::adds::list) fill(part(p[*f], rows), 0.0, state.threads);
  if (wet_walls_.empty()) return;
  const PairTerm term =
      kernels.shear.even() ? pair_term<WallExtrapolation> : pair_term<WallExtrapolationWeighted>;
  add_alone_here(state, alone_pass(state, term), kernels, wet_);

  const auto weight = p[field::wall_weight];
  const auto moved = triple(p, field::wall_velocity);
  const auto seen = triple(p, field::viscous_velocity);
  const auto v = velocities(p);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t k = 0; k < wet_walls_.size(); ++k) {
    const std::size_t i = wet_walls_[k];
    if (weight[i] > 0.0)
      seen.set(i, v.at(i) + (v.at(i) - moved.at(i) / weight[i]));
    else if (i >= p.moving())
      seen.set(i, {});
  }
}

}  // namespace tripoint::no_slip
