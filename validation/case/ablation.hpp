// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/effect_rule.hpp"
#include "validation/case/case.hpp"

/// Corrections that a case can be run without: one after the other is taken back, all others stay.
namespace tripoint {

/// A row of `tripoint ablate`: a term of two forms, which is put back to its printed one, or a key. At 0 the key leaves out a
/// term that the paper does not have.
struct Correction {
  std::string name;                  ///< of the term, or of the key
  std::optional<Term> term{};        ///< none: it is a key
  const EffectRule* rule = nullptr;  ///< whose key it is
  const EffectKey* key = nullptr;
};

/// All that effects declare: terms first, then keys.
[[nodiscard]] std::vector<Correction> corrections();
/// Whether it can act in the scene. A correction that acts nowhere has no row: its runs have the bits of the corrected ones.
[[nodiscard]] bool can_act(const Correction&, const Scene&);
/// The case at its own resolution, fully corrected, without studies and gates. With the transport velocity it clamps as the file
/// says.
[[nodiscard]] Case corrected(Case);
[[nodiscard]] Case without(const Correction&, Case);

}  // namespace tripoint
