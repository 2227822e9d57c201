// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "pairs/run_pass.hpp"
#include "sph/kernels.hpp"
#include "state/state.hpp"

namespace tripoint::no_slip {

/// The velocity that viscous pairs see of walls is the mirrored one, v = 2 v_wall - mean v_f [Adami, Hu,
/// Adams 2012].
class MirroredVelocity {
 public:
  /// Sets the viscous velocity of the walls that liquid is near, where it sticks to them.
  void mirror(State&, const PairKernels&, const Rows&);
  /// Rows or groups have changed: look again which particles are walls.
  void clear() { known_ = -1; }

 private:
  void find(State&, const Rows&);

  std::vector<std::uint32_t> wet_walls_;  ///< rows of walls with liquid in their lists that it sticks to
  ChosenClusters wet_;                    ///< their clusters
  long known_ = -1;                       ///< the rebuild that the rows are of
};

}  // namespace tripoint::no_slip
