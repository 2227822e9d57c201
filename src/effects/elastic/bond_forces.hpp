// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "core/aligned.hpp"
#include "effects/solid_particles.hpp"

/// The two passes over bonds. Reference data stream by in order of the lists; what a pass needs of a partner lies together in
/// three lines of the cache, by id.
namespace tripoint::elastic {

/// What bonds see of a particle.
struct alignas(64) Deformed {
  Vec3 r;
  double volume = 0.0;
  Matrix3 strained;  ///< F - I; with the stress, that of a sheet or chain becomes its strain
  Matrix3 T;         ///< H until the stress is known, then (v F S + H) A: force of i on j is -v_j T gradW(x_ij), and of the residual [N m]
  double full = 0.0, flat = 0.0;  ///< a E/2 where the hourglass energy is that of a solid, of a sheet or chain [Pa]
};
static_assert(sizeof(Deformed) == 192);

/// Memory of the passes, filled anew each step.
struct Deformations {
  struct alignas(32) Place {
    Vec3 r;
    double volume;
  };
  AlignedVector<Place> places;       ///< by id
  AlignedVector<Deformed> deformed;  ///< by id
};

/// F, strain and the hourglass part H = sum_j c_ij (F x_ji - r_ji) x_ji^T of all particles of deformable bodies.
void deform(World&, const solid::ElasticForms&, Deformations&);
/// (12) and the gradient of the hourglass energies, on every particle that has bonds, rigid or not.
void add_forces(World&, const solid::ElasticForms&, Deformations&);

}  // namespace tripoint::elastic
