// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>
#include <vector>

#include "effects/effect.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "scene/temperatures.hpp"
#include "solids/solid_particles.hpp"
#include "state/ordered_sum.hpp"

/// Thermal expansion of elastic bodies: a strain a (T - T0) I that bears no stress (model 8.13). It stands in
/// the columns of plastic strain, which elasticity takes off the whole strain.
namespace tripoint::expansion {
namespace {

namespace account {
constexpr EnergyAccount taken{"expansion"};  ///< elastic energy that a change of temperature took [J]
}

struct Law {
  double coefficient = 0.0, temperature = 0.0;  ///< [1/K], [K]
  /// Green's strain of a length that is 1 + a (T - T0) times as long.
  [[nodiscard]] Symmetric strain(double T) const {
    const double e = coefficient * (T - temperature), green = e + 0.5 * e * e;
    return {green, green, green, 0.0, 0.0, 0.0};
  }
};

class Expansion : public Effect {
 public:
  explicit Expansion(const Scene& scene) : forms_(scene) {}
  void load(State&, const InitialState&) override;
  void state(State&, const Rows&) override;
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["expansion"] += state.accumulated[account::taken];
  }

 private:
  [[nodiscard]] double expand(State&, std::size_t row) const;

  solid::ElasticForms forms_;
  std::vector<Law> laws_;  ///< of each material
};

void Expansion::load(State& state, const InitialState& initial) {
  laws_.clear();
  for (std::size_t n = 0; n < state.scene.materials.size(); ++n)
    laws_.push_back({value_of(state.scene.materials[n].values, "thermal_expansion"),
                     expansion_temperature(state.scene, initial, n, Phase::elastic)});
  Particles& p = state.particles;
  const solid::ElasticParticles is_elastic(state);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Law& law = laws_[static_cast<std::size_t>(p[field::material][i])];
    if (is_elastic(i))
      solid::set_plastic_strain(p, i,
                                law.strain(initial.temperature[static_cast<std::size_t>(p[field::id][i])]));
  }
}

/// @return elastic energy that the change of temperature took [J]
double Expansion::expand(State& state, std::size_t row) const {
  Particles& p = state.particles;
  const Symmetric strain = laws_[static_cast<std::size_t>(p[field::material][row])].strain(
      std::as_const(p)[field::temperature][row]);
  if (strain == solid::plastic_strain_of(p, row)) return 0.0;
  const auto id = static_cast<std::uint32_t>(p[field::id][row]);
  const double before = solid::deformation_energy(state, forms_, id).elastic;
  solid::set_plastic_strain(p, row, strain);
  return before - solid::deformation_energy(state, forms_, id).elastic;
}

/// Where places and temperatures are those of the end of the step, before the strain is formed.
void Expansion::state(State& state, const Rows&) {
  const solid::ElasticParticles is_elastic(state);
  std::vector<std::array<double, 1>> blocks;
  const auto taken = ordered_sums(state.particles.size(), state.threads, blocks,
                                  [&](std::size_t row, std::array<double, 1>& sum) {
                                    if (is_elastic(row)) sum[0] += expand(state, row);
                                  });
  state.accumulated[account::taken] += taken[0];
  state.accumulated[tripoint::account::deformation_released] += taken[0];
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"expansion", scene.mode_of(term::elastic),
               fields::joined({fields::plastic_strain(), {field::may_flow}}),
               fields::joined({fields::position(),
                               fields::deformation(),
                               {field::id, field::mass, field::body, field::material, field::temperature}})};
  s.accounts = {account::taken};
  s.reads_if_there = fields::joined({fields::image(), {field::stiffness_share}});
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) {
  for (const char* other : {"plastic", "phase"})
    if (calls_for(scene, other))
      throw InputError(std::string("a solid with thermal_expansion does not ") +
                       (other == std::string("phase") ? "melt or freeze" : "yield") +
                       " in the same scene: leave one of the two out");
  return std::make_unique<Expansion>(scene);
}

}  // namespace tripoint::expansion
