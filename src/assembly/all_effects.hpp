// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "assembly/plan.hpp"
#include "effects/effect.hpp"

namespace tripoint {

/// One effect that a scene has on.
struct Active {
  std::string name, why;
  EffectSpec spec;
  std::unique_ptr<Effect> effect;
  DeclaredFields declared{};  ///< all that it may ask for
};

/// Effects that the scene calls for, in the order in which they run. @throws InputError naming one that is
/// not in this build
[[nodiscard]] std::vector<Active> active_effects(const Scene&);
/// First effect that the scene calls for and this build does not have; empty = none.
[[nodiscard]] std::string missing_effect(const Scene&);

/// What these effects ask of the fused pair passes.
[[nodiscard]] std::vector<EffectPairWork> pair_work(const Scene&, const std::vector<Active>&);
/// By particle, 1 where its body never moves and pairs among such have no work (ParticleCost); empty: all
/// pairs have work.
[[nodiscard]] std::vector<char> idle_particles(const Scene&, const InitialState&);

/// Puts the forces, energy accounts and guards that these effects declare into the state.
void declare(State&, const std::vector<Active>&);

}  // namespace tripoint
