// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

/// Solids that overlap at the start press against nothing at first, and are let out slowly (model 8.3): their
/// rest density is that of the start, and falls back to the material's.
namespace tripoint::pressure {

/// Whether a density is a sum over solids alone, by the corrected forms, and contact does not pull.
[[nodiscard]] bool lets_solids_out(const Scene&);

/// Time since the start [s]; -1 before the first drift, and none_let_out after it where nothing overlapped
inline constexpr StepNumber let_out_for{"solids_let_out_for", -1.0, true};
inline constexpr double none_let_out = std::numeric_limits<double>::max();

/// Before the first drift: the densities of these rows become their rest densities, where they are greater.
void take_as_rest(State&, const Rows&);

/// The rest densities after dt [s]. @returns energy of compression that this puts in [J]
[[nodiscard]] double let_out(State&, const liquid::SceneNumbers&, double dt);

/// Whether solids overlapped at the start.
[[nodiscard]] bool has_let_out(const State&);

}  // namespace tripoint::pressure
