// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "effects/fluid/material_numbers.hpp"
#include "world/world.hpp"

namespace tripoint::fluid {

/// What the energy of compression, with the core's, jumps by as World::change ends and makes own pairs and groups [J]: of the
/// changed particles and their pairs alone. To be called while the columns `group` and `own_density` and
/// the marks of the neighbour lists still tell of before. @param group_now group of a row after the change
/// @param back time before now at which the particles are looked at: half a drift, since the kick before it had the forces of
/// before the change, and the kick after it has those of after [s]
[[nodiscard]] double compression_jump(const World&, const SceneNumbers&, const PairKernels&,
                                      const std::function<double(std::size_t)>& group_now, double back);

}  // namespace tripoint::fluid
