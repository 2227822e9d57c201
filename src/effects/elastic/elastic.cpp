// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/elastic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "effects/elastic/bond_forces.hpp"
#include "effects/elastic/fields.hpp"
#include "scene/effect_rule.hpp"
#include "scene/phase_values.hpp"
#include "scene/shared_terms.hpp"
#include "state/ordered_sum.hpp"

namespace tripoint::elastic {
namespace {

/// Share of h/c_L, 0.47 to 0.57 of the frontier (model 8.10).
constexpr double courant = 0.3, courant_with_hourglass = 0.25;

class Elastic : public Effect {
 public:
  explicit Elastic(const Scene& scene) : forms_(scene) {}
  void load(State&, const InitialState&) override;
  void state(State& state, const Rows&) override { deform(state, forms_, deformations_); }
  void bonds(State& state, const Rows&) override { add_forces(state, forms_, deformations_); }
  void adopt(State&) override;
  void renumber(State&) override { deformations_ = {}; }
  void check(const State& state) const override { refuse_inversion(state, forms_, deformations_); }
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;

 private:
  solid::ElasticForms forms_;
  Deformations deformations_;  ///< memory that is used again
};

void Elastic::load(State& state, const InitialState&) {
  std::vector<std::uint32_t> ids(state.particles.size());
  std::iota(ids.begin(), ids.end(), 0u);
  solid::refresh_shapes(state, ids, true);
}

void Elastic::adopt(State& state) {
  std::vector<std::uint32_t> ids = state.change.relisted;
  ids.insert(ids.end(), state.change.regrouped.begin(), state.change.regrouped.end());
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  solid::refresh_shapes(state, ids);
}

/// 0.25 h/(c_L sqrt(max(1, a))), 0.3 h/c_L without hourglass; for lists that were changed 1/sqrt(2 max of the
/// squared local frequency) (model 8.10).
TimeStepBound Elastic::max_dt(const State& state) const {
  TimeStepBound bound;
  const double a = forms_.hourglass(),
               share = a > 0.0 ? courant_with_hourglass / std::sqrt(std::max(1.0, a)) : courant;
  for (const Body& b : state.scene.bodies) {
    const Material& m = state.scene.material(b.material);
    if ((b.phase == Phase::rigid && !turns_elastic(state.scene, m)) || !m.young_modulus || !m.poisson_ratio)
      continue;
    const solid::ElasticConstants c = solid::elastic_constants(*m.young_modulus, *m.poisson_ratio);
    tighten(bound,
            share * bond_reach(state.scene) * state.scene.spacing /
                std::sqrt((c.lambda + 2.0 * c.mu) / m.density),
            "elastic wave");
  }
  if (!state.particles.has(field::bond_frequency.name)) return bound;
  double greatest = 0.0;
  for (const double frequency : state.particles[field::bond_frequency])
    greatest = std::max(greatest, frequency);
  if (greatest > 0.0) tighten(bound, 0.5 * 2.0 / std::sqrt(2.0 * greatest), "bonds");
  return bound;
}

void Elastic::add_to(const State& state, Ledger& ledger) const {
  std::vector<std::array<double, 2>> blocks;
  const auto sums = ordered_sums(
      state.particles.size(), state.threads, blocks, [&](std::size_t id, std::array<double, 2>& sum) {
        if (!state.owns(state.particles.row(id))) return;
        const solid::DeformationEnergy energy =
            solid::deformation_energy(state, forms_, static_cast<std::uint32_t>(id));
        sum[0] += energy.elastic;
        sum[1] += energy.hourglass;
      });
  ledger.energy["elastic"] += sums[0];
  ledger.energy["hourglass"] += sums[1];
}

bool can_freeze(const Scene& scene) { return calls_for(scene, "phase"); }

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"elastic",
               scene.mode_of(term::elastic),
               {field::elastic_force, field::shape_inverse, field::shape_rank, field::solid_volume,
                field::solid_material, field::solid_stiffness, field::regular_bonds, field::strain},
               fields::joined({fields::position(), {field::id, field::mass, field::body, field::material}})};
  s.bounded = {{field::shape_rank, 0, [](const State&) -> std::size_t { return 4; }},  // 0 to 3
               {field::solid_material, 0, [](const State& w) { return w.scene.materials.size(); }}};
  s.reads_if_there = fields::joined({fields::deformation_if_there(), {field::may_flow}});
  if (can_freeze(scene)) s.owns.emplace_back(field::bond_frequency);
  Force bonds{field::elastic_force, {"elastic_work"}, EnergyAccount{"wall_elastic_work"}};
  bonds.stored = StoredEnergy{{"elastic", "hourglass"}, {"start_deformation"}, account::deformation_released};
  s.forces = {bonds};
  s.own_sums.bonds = columns_of_all(field::elastic_force);
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Elastic>(scene); }

}  // namespace tripoint::elastic
