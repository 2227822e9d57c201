// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/let_out.hpp"

/// What letting solids out that overlap at the start does (model 8.3): their rest density is that of the
/// start and falls back to the material's, and the core of pairs grows meanwhile.
namespace tripoint::pressure {

/// At the first forces: the densities of these rows become their rest densities, where they are greater.
void take_as_rest(State&, const Rows&);

/// Whether solids overlap at the start.
[[nodiscard]] bool has_let_out(const State&);
/// At the first forces: all processes know whether solids overlap at the start of one, and whether by so much
/// that the core of pairs is let out too.
void begin_letting_out(State&, const liquid::SceneNumbers&);

/// The rest densities after dt [s]. @returns energy of compression that this puts in [J]
[[nodiscard]] double let_out(State&, const liquid::SceneNumbers&, double dt);

}  // namespace tripoint::pressure
