// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/pair_term.hpp"
#include "particles/columns.hpp"

namespace tripoint {

struct PairKernels;

/// Work that an effect asks of the fused passes in a scene: the terms that it needs, of those that its
/// pair_slots.hpp has compiled.
struct PairWork {
  std::vector<PairTerm> terms{};  ///< that the passes of density and rates sum
  /// Its terms add nothing to pairs that do not act on each other (Clusters::acting)
  bool where_it_acts = false;
  bool leaves_excluded_pairs = false;  ///< its density leaves excluded pairs out
  /// Of its density terms those that are left out where State::holds_sums says so
  std::vector<PairTerm> held{};
  /// Its rates are computed a second time in each step, without those of others
  bool again = false;
  /// The kernels that all terms of the scene use, of the effect, which outlives the passes; at most one has
  /// them
  const PairKernels* kernels = nullptr;
  /// How far around what something can reach its sums read fixed particles [m]
  double awake_around = 0.0;
};

/// The work of one effect of a scene.
struct EffectPairWork {
  PairWork work;
  DeclaredFields declared;  ///< by the effect: its terms may use no other
  bool skips_sleeping;      ///< EffectSpec::skips_sleeping
};

/// again: the rates at the predicted state, of those effects alone that have a second stage.
enum class PassName { density, rates, again };

}  // namespace tripoint
