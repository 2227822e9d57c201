// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "assembly/all_effects.hpp"
#include "assembly/declared_view.hpp"

namespace tripoint {

/// Visits the effects of a scene in the order of the one list; each sees the columns that it has declared,
/// and no other.
/// @param visit called as visit(Effect&)
template <class Visit>
void for_each_effect(const State& state, const std::vector<Active>& effects, Visit visit) {
  for (const Active& a : effects) {
    const DeclaredView view(state, a);
    visit(*a.effect);
  }
}

/// The same for a stage whose sums the ghosts of other processes take (EffectSpec::own_sums).
template <class Visit>
void for_each_effect(State& state, const std::vector<Active>& effects,
                     std::vector<const Field<double>*> OwnSums::*sums, Visit visit) {
  for (const Active& a : effects) {
    {
      const DeclaredView view(state, a);
      visit(*a.effect);
    }
    if (state.halo && !(a.spec.own_sums.*sums).empty()) state.refresh(a.spec.own_sums.*sums);
  }
}

}  // namespace tripoint
