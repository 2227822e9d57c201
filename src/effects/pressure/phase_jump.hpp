// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

namespace tripoint::pressure {

/// Change of energy of compression and core [J] when State::change ends and makes excluded pairs and groups.
/// It is summed over the changed particles and their pairs. @pre the columns `group` and `own_density` and
/// the marks of the neighbour lists are those of before the change. @param group_now group of a row after the
/// change @param back time before now at which energies are compared [s]. It is half a drift: the kick before
/// has the old forces, the kick after it the new ones
[[nodiscard]] double compression_jump(const State&, const liquid::SceneNumbers&, const PairKernels&,
                                      const std::function<double(std::size_t)>& group_now, double back);

}  // namespace tripoint::pressure
