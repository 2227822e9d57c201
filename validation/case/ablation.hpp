// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/model.hpp"
#include "validation/case/case.hpp"

/// Corrections that a case can be run without: one after the other is taken back, all others stay.
namespace tripoint {

/// A row of `tripoint ablate`: a term that is put back to a form with less.
struct Correction {
  /// Of the term: without its correction; "TERM=WORD": in its default form, where a scene has a better one
  std::string name;
  const ModelTerm* of;
  const ModelForm* form;
};

/// Of every term of [model], in its order.
[[nodiscard]] std::vector<Correction> corrections();
/// Whether it can act in the scene. A correction that acts nowhere has no row: its runs have the bits of the
/// corrected ones.
[[nodiscard]] bool can_act(const Correction&, const Scene&);
/// The case at its own resolution, fully corrected, without studies and gates. With the transport velocity it
/// clamps as the file says.
[[nodiscard]] Case corrected(Case);
[[nodiscard]] Case without(const Correction&, Case);

}  // namespace tripoint
