// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "effects/fluid/material_numbers.hpp"
#include "world/world.hpp"

namespace tripoint::fluid {

/// Change of the energy of compression and core [J] that World::change causes by ending and making own pairs and groups: summed
/// over the changed particles and their pairs. @pre the columns `group` and `own_density` and the marks of the neighbour lists
/// are those of before the change. @param group_now group of a row after the change @param back time before now at which energies
/// are compared [s]: half a drift, since the kick before it had the forces of before the change and the kick after it has the new
/// ones
[[nodiscard]] double compression_jump(const World&, const SceneNumbers&, const PairKernels&,
                                      const std::function<double(std::size_t)>& group_now, double back);

}  // namespace tripoint::fluid
