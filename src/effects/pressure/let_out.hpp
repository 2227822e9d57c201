// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/let_out.hpp"

/// What letting solids out that overlap at the start does (model 8.3): their rest density is that of the
/// start and falls back to the material's, and the core of pairs grows meanwhile.
namespace tripoint::pressure {

/// Before the first drift: the densities of these rows become their rest densities, where they are greater.
void take_as_rest(State&, const Rows&);

/// Whether solids overlap at the start: before the first drift by what is there, then as all processes found.
[[nodiscard]] bool has_let_out(const State&, const liquid::SceneNumbers&);
/// At the first drift: all processes know whether solids overlap at the start of one. @param here  of this
/// one
void begin_letting_out(State&, bool here);

/// The rest densities after dt [s]. @returns energy of compression that this puts in [J]
[[nodiscard]] double let_out(State&, const liquid::SceneNumbers&, double dt);

}  // namespace tripoint::pressure
