// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "effects/phase/released_energy.hpp"

/// The melts and freezes of one step, taken together (model 8.9).
namespace tripoint::phase {

/// Ids of particles that change their phase, ascending. `turned` particles are solid as before: rigid matter
/// that is elastic now, or the other way (Fig. 5).
struct Events {
  std::vector<std::uint32_t> melted, frozen, turned;
  [[nodiscard]] bool empty() const { return melted.empty() && frozen.empty() && turned.empty(); }
};
/// Liquid at f = 1, solid at f = 0; between the two a particle keeps its phase. As printed a rigid material
/// may be rigid at f = 0 alone, and elastic above. Particles that the scene gave to a held or driven body
/// stay rigid, as do all of an elastic body that is held.
[[nodiscard]] Events events_of(const State&);

/// Whether what freezes beside this solid joins it: it can melt itself, or its body has `joins = true`.
[[nodiscard]] bool may_join(const State&, std::size_t row);

/// Bonds between the members of rigid bodies that can melt, up to the distance that joins, so that splitting
/// is seen.
void connect_rigid_bodies(State&);

/// Ends bonds and excluded pairs of melting particles, and keeps those of turning ones. Bonds freezing ones
/// to those that they touch. Makes bodies of connected particles, and writes it all to State::change.
/// Neighbour lists must be of the present places.
void carry_out(State&, const Events&, ReleasedEnergy&);

}  // namespace tripoint::phase
