// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sph/kernels.hpp"
#include "state/state.hpp"

/// Bonds and excluded pairs of freezing particles (model 8.9).
namespace tripoint::phase {

/// A pair that becomes body neighbours.
struct Joint {
  std::uint32_t i, j;  ///< ids: i freezes
  Vec3 r;              ///< r_i - r_j now [m]
  bool both;           ///< j freezes too: neither has a reference of its own yet
};

/// Makes the bonds. Frozen particles take the present vectors. A deformable solid j that was there before
/// first turns its list into the present frame. It takes the new vector in its reference, F_j^-1 r_ji:
/// nothing of j jumps.
void bond(State&, const std::vector<Joint>&);

/// Applies to a list without strain energy, as of a member of a rigid body that is bonded to no deformable
/// partner. The present vectors to its bonded neighbours become its reference vectors. They differ by the
/// body's rotation alone.
void take_present_vectors(State&, const ElasticityKernel&, std::uint32_t id);

/// From now on frozen deformable particles meet the near members of their body through their bonds alone.
void make_excluded_pairs(State&, const std::vector<std::uint32_t>& frozen);

}  // namespace tripoint::phase
