// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace tripoint {

struct State;

/// Particles leave the state. The others keep their order and get ids from 0 on; data by row or id are void.
/// @param ids ascending, of particles without bonds and excluded pairs
void drop_particles(State&, std::span<const std::uint32_t> ids);
/// So that `count` are left: those of the least ids.
void keep_particles(State&, std::size_t count);

}  // namespace tripoint
