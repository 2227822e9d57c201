// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "assembly/all_effects.hpp"

namespace tripoint {

/// Shares a scene's particles out among the processes that hold it. @pre World::halo: one process alone has nothing to share
class Sharing {
 public:
  /// @param skin how far a particle may move before it is shared out again, twice over and in support radii
  explicit Sharing(double skin) : skin_(skin) {}
  /// Where the lists of one process are outdated, particles go to who has their place now, and all make new lists. All call it.
  void follow(World&, const std::vector<Active>&);

 private:
  [[nodiscard]] bool outdated(const World&) const;

  double skin_;
  std::vector<Vec3> shared_at_;  ///< by row: where particles were when last shared out [m]; of scenes without neighbour lists
};

/// Tells of each row whether it is a copy of another process's particle.
void mark_copies(World&);

}  // namespace tripoint
