// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "effects/phase/released_energy.hpp"

/// The melts and freezes of one step, taken together (model 8.9).
namespace tripoint::phase {

/// Ids of what changes its phase, ascending. What has turned is solid as before: rigid matter that is elastic now, or the other
/// way (Fig. 5).
struct Events {
  std::vector<std::uint32_t> melted, frozen, turned;
  [[nodiscard]] bool empty() const { return melted.empty() && frozen.empty() && turned.empty(); }
};
/// Liquid at f = 1, solid at f = 0; between the two a particle keeps its phase. As printed a rigid material may be rigid at f = 0
/// alone, and elastic above; particles that the scene gave to a held or driven body stay rigid, as all of an elastic body that is
/// held does.
[[nodiscard]] Events events_of(const World&);

/// Whether what freezes beside this solid joins it: it can melt itself, or its body has `joins = true`.
[[nodiscard]] bool may_join(const World&, std::size_t row);

/// Bonds between the members of rigid bodies that can melt, up to the distance that joins, so that splitting is seen.
void connect_rigid_bodies(World&);

/// Ends bonds and own pairs of what melts, keeps those of what turns, bonds what freezes to what it touches, makes bodies of what
/// hangs together, and tells it all in World::change. Neighbour lists must be of the present places.
void carry_out(World&, const Events&, ReleasedEnergy&);

}  // namespace tripoint::phase
