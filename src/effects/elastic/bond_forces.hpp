// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/elastic/bond_sums.hpp"
#include "solids/solid_particles.hpp"

/// The two passes over bonds. Reference data are read in order of the lists. The data of a partner that a
/// pass needs lie together, by id.
namespace tripoint::elastic {

/// The quantities that a stress is formed from. They are kept where matter may flow (field::may_flow): flow
/// comes after the strain, and changes the stress of few.
struct BeforeFlow {
  Matrix3 G;            ///< F - I [1]
  Matrix3 H;            ///< sum_j c_ij (F x_ji - r_ji) x_ji^T of the hourglass energy [N m]
  Symmetric plastic{};  ///< eps_p that the stress was formed with [1]
};

/// Memory of the passes. `reference` is kept until bonds, volumes or owners change; the rest is filled anew
/// each step.
struct Deformations {
  BondLists lists;
  AlignedVector<Place> places;           ///< by id
  AlignedVector<Deformed> deformed;      ///< by id, of particles that have bonds or own strain energy
  std::vector<ReferenceSums> reference;  ///< by id, the same
  /// By id: force of a particle's own hourglass energy on it, of a solid [N]
  std::vector<Vec3> hourglass_force;
  std::vector<BeforeFlow> before_flow;  ///< by id, set where matter may flow; empty in a scene without flow
  double least_volume_ratio = 1.0;      ///< least det F of a solid
  std::vector<char> owns;               ///< by id, 1 where it owns strain energy
};

/// F, strain, H and the stress of all particles of deformable bodies, at the plastic strain so far. H = sum_j
/// c_ij (F x_ji - r_ji) x_ji^T is the hourglass part.
void deform(State&, const solid::ElasticForms&, Deformations&);
/// @throws Diverged where a particle of a solid is turned inside out: det F <= 0. Two measures are not
/// checked. Printed strain is no measure of F, because a rotation alone changes its sign. F of a sheet or
/// chain is that within its plane or line.
void refuse_inversion(const State&, const solid::ElasticForms&, const Deformations&);
/// (12) and the gradient of the hourglass energies, on every particle that has bonds, rigid or not.
void add_forces(State&, const solid::ElasticForms&, Deformations&);

}  // namespace tripoint::elastic
