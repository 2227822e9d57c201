// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <memory>
#include <vector>

#include "effects/effect.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/interface_weight.hpp"
#include "liquids/scene_numbers.hpp"
#include "scene/effect_rule.hpp"
#include "state/ordered_sum.hpp"

/// Pressure is right on both sides of a level interface of two liquids (model 8.3).
namespace tripoint::interfaces {
namespace {

double share_of(const Scene& scene) { return acting_number(scene, "interface_weight"); }

std::vector<double> densities_of_liquids(const State& state) {
  const auto group = state.particles[field::group], rest = state.particles[field::rest_density];
  std::vector<double> density(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) density[i] = group[i] == liquid_group ? rest[i] : 0.0;
  return density;
}

class Interfaces : public Effect {
 public:
  explicit Interfaces(const Scene& scene)
      : kernels_(liquid::pair_kernels(scene)), weight_(scene, share_of(scene)) {}
  void bonds(State& state, const Rows& rows) override {
    weight_.add_forces(state, kernels_, densities_of_liquids(state), rows);
  }
  void adopt(State& state) override {
    if (liquid::groups_changed(state)) weight_.clear();
  }
  void happen(State&, const Happening&) override { weight_.clear(); }
  void renumber(State&) override { weight_.clear(); }
  void add_to(const State& state, Ledger& ledger) const override {
    std::vector<std::array<double, 1>> blocks;
    const std::vector<double> density = densities_of_liquids(state);
    const auto energy = ordered_sums_of_all(state, blocks, [&](std::size_t i, std::array<double, 1>& sum) {
      if (i < state.neighbours->rows()) sum[0] += weight_.energy(state, kernels_, density, i);
    });
    ledger.energy["compression"] += energy[0];
  }

 private:
  PairKernels kernels_;
  liquid::InterfaceWeight weight_;
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{
      "interfaces",
      Mode::corrected,
      {},
      fields::joined({fields::position(), {field::id, field::group, field::rest_density, field::force}})};
  s.reads_if_there = fields::image();
  s.skips_sleeping = true;
  s.own_sums.bonds = columns_of_all(field::force);
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Interfaces>(scene); }

}  // namespace tripoint::interfaces
