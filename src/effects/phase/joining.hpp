// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "sph/kernels.hpp"
#include "world/world.hpp"

/// Bonds and own pairs of what freezes (model 8.9).
namespace tripoint::phase {

/// A pair that becomes body neighbours.
struct Joint {
  std::uint32_t i, j;  ///< ids: i freezes
  Vec3 r;              ///< r_i - r_j now [m]
  bool both;           ///< j freezes too: neither has a reference of its own yet
};

/// Makes the bonds. What freezes takes the present vectors. A deformable solid j that was there before first turns its list into
/// the present frame, and takes the new vector in its reference, F_j^-1 r_ji: nothing of j jumps.
void bond(World&, const std::vector<Joint>&);

/// Of a list without strain energy, as that of a member of a rigid body without a deformable partner: the vectors to its mates,
/// which are as they were but for the body's turn, become the present ones.
void take_present_vectors(World&, const ElasticityKernel&, std::uint32_t id);

/// What froze and is deformable meets the near members of its body through their bonds alone from now on.
void make_own_pairs(World&, const std::vector<std::uint32_t>& frozen);

}  // namespace tripoint::phase
