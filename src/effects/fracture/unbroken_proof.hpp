// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <vector>

#include "state/state.hpp"

namespace tripoint::fracture {

/// The proof that no bond can have broken since all were checked. It compares the least headroom that any
/// bond had then with the distance that particles have moved since, relative to each other. It changes no
/// result, so that no checkpoint keeps it.
class UnbrokenProof {
 public:
  /// Nothing is known: bonds, bodies or particles are others than before.
  void clear() noexcept { place_.clear(); }
  /// @param headroom least headroom of all bonds, as the particles are now [m]
  void set(const State&, double headroom);
  /// Whether every bond still holds.
  [[nodiscard]] bool holds(const State&) const;

 private:
  double headroom_ = 0.0;
  std::vector<Vec3> place_;  ///< by id, when all were looked at
};

}  // namespace tripoint::fracture
