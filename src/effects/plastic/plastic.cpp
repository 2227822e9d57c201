// SPDX-License-Identifier: BSD-3-Clause
#include "effects/plastic/plastic.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "effects/plastic/flow.hpp"
#include "scene/shared_terms.hpp"
#include "solids/solid_particles.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::plastic {
namespace {

/// Energy that plastic flow has dissipated [J].
constexpr EnergyAccount dissipation{"plastic"};

class PlasticFlow : public Effect {
 public:
  explicit PlasticFlow(const Scene&);
  void state(State&, const Rows&) override;
  void adopt(State&) override;
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["plastic"] += state.accumulated[dissipation];
  }

 private:
  double flow(State&, std::size_t row) const;

  solid::ElasticForms forms_;
  std::vector<YieldLimits> limits_;            ///< of each material
  std::vector<std::array<double, 1>> blocks_;  ///< memory that is used again
};

PlasticFlow::PlasticFlow(const Scene& scene) : forms_(scene) {
  for (const Material& m : scene.materials) {
    YieldLimits limits;
    if (m.elastic_limit) limits.elastic = *m.elastic_limit;
    if (m.plastic_limit) limits.plastic = *m.plastic_limit;
    limits_.push_back(limits);
  }
}

/// @return energy that it turned to heat [J]
double PlasticFlow::flow(State& state, std::size_t row) const {
  Particles& p = state.particles;
  const YieldLimits& limits = limits_[static_cast<std::size_t>(p[field::material][row])];
  const int rank = p[field::shape_rank][row];
  const Symmetric strain = solid::strain_of(p, row), plastic = solid::plastic_strain_of(p, row);
  const Symmetric P = forms_.projector(solid::shape_inverse_of(p, row), rank),
                  elastic = between(P, strain - plastic);
  const solid::ElasticConstants c = forms_.constants(state, row);
  const double yields = yield_stress(c.mu, limits.elastic);
  const auto flat = [&] {
    return flowed_flat(elastic, forms_.stress(elastic, P, rank, c), plastic, rank, yields, limits.plastic);
  };
  const Symmetric after = rank == 3 ? flowed(strain, plastic, limits) : flat();
  if (after == plastic) return 0.0;
  solid::set_plastic_strain(p, row, after);
  const Symmetric step = between(P, after - plastic);
  return p[field::solid_volume][row] * dissipated(forms_.stress(elastic - step, P, rank, c), step);
}

/// After the strain of the present time is known, before its stress.
void PlasticFlow::state(State& state, const Rows&) {
  const auto may_flow = std::as_const(state.particles)[field::may_flow];
  if (std::ranges::find(may_flow, 1) == may_flow.end()) return;
  const solid::ElasticParticles is_elastic(state);
  const auto lost = ordered_sums(state.particles.size(), state.threads, blocks_,
                                 [&](std::size_t row, std::array<double, 1>& sum) {
                                   if (may_flow[row] != 0 && is_elastic(row) && state.owns(row))
                                     sum[0] += flow(state, row);
                                 });
  state.accumulated[dissipation] += lost[0];
  state.accumulated[account::deformation_released] += lost[0];
}

/// Melted particles lose their plastic strain.
void PlasticFlow::adopt(State& state) {
  for (const auto* list : {&state.change.melted, &state.change.born})
    for (const std::uint32_t id : *list)
      solid::set_plastic_strain(state.particles, state.particles.row(id), {});
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{
      "plastic",
      scene.mode_of(term::elastic),
      fields::joined({fields::plastic_strain(), {field::may_flow}}),
      fields::joined({fields::strain(), fields::deformation(), {field::id, field::body, field::material}}),
      {},
      {dissipation}};
  s.reads_if_there = {field::stiffness_share};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<PlasticFlow>(scene); }

}  // namespace tripoint::plastic
