// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "effects/body_table.hpp"
#include "sph/kernels.hpp"
#include "sph/solid.hpp"

/// What elasticity, plasticity, fracture and change of phase share: bonds and own pairs of a world, and how its particles are
/// deformed. Particles are named by id.
namespace tripoint::solid {

inline constexpr double bond_ratio = 2.12;  ///< reach of the first bonds, and support of the kernel (17), in spacings

/// A bond with this reference vector x_ij and its kernel (17); who it is with is set by connect().
[[nodiscard]] Bond bond_of(const ElasticityKernel&, const Vec3& x_ij);
[[nodiscard]] ElasticityKernel bond_kernel(const Scene&);
/// W of the density kernel: the weight of an own pair at this distance [1/m3].
[[nodiscard]] double own_weight(const Scene&, double distance);
/// r_j - r_i [m] of the nearest images. @param i,j rows
[[nodiscard]] Vec3 separation(const World&, std::size_t i, std::size_t j);

/// Bonds and own pairs within each deformable body of the scene, and to bodies that it is joined to.
/// @throws InputError when a periodic direction is too narrow for bonds to be told apart
void connect_solids(World&);

/// Tells of rows whether they are particles of deformable bodies: these own strain energy.
class ElasticParticles {
 public:
  explicit ElasticParticles(const World& world) : body_(world.particles[field::body]), is_rigid_(world) {}
  [[nodiscard]] bool operator()(std::size_t row) const { return body_[row] >= 0 && !is_rigid_(row); }

 private:
  std::span<const int> body_;
  RigidMembers is_rigid_;
};

/// Volume, A_i and rank of these particles by their present lists and bodies, zero where they are no elastic particles; with
/// their partners, which lists mirror each other and, where the scene can freeze, the frequency of each particle.
/// @param first lists are those of the start: no frequency is needed
void refresh_shapes(World&, std::span<const std::uint32_t> ids, bool first = false);

/// How a particle of a deformable body is deformed, by its list and the places of now.
struct Deformation {
  Matrix3 F = identity3;
  Symmetric P;       ///< projector on the range of M_i
  Symmetric strain;  ///< total, within P
  int rank = 0;
};

/// The scene's forms of elasticity, prepared once. Functions of one particle; `of` reads no column but bonds, volumes and A_i.
class ElasticForms {
 public:
  explicit ElasticForms(const Scene&);
  [[nodiscard]] bool paper() const noexcept { return paper_; }
  /// Coefficient a of the hourglass energy, 0 = none.
  [[nodiscard]] double hourglass() const noexcept { return hourglass_; }
  /// Constants of a particle [Pa], softened where its material softens.
  [[nodiscard]] ElasticConstants constants(const World&, std::size_t row) const;
  [[nodiscard]] Symmetric projector(const Symmetric& shape_inverse, int rank) const;
  /// Strain within P of a particle with this F.
  [[nodiscard]] Symmetric strain(const Matrix3& F, const Symmetric& P, int rank) const;
  /// S of the elastic strain P (eps - eps_p) P.
  [[nodiscard]] Symmetric stress(const Symmetric& elastic_strain, const Symmetric& P, int rank, const ElasticConstants&) const;
  /// What multiplies v F S d_ij in (12): 1, printed 2.
  [[nodiscard]] double force_factor() const noexcept { return factor_; }

 private:
  bool paper_;
  double hourglass_, factor_;
  std::vector<ElasticConstants> constants_;  ///< of each material
  std::vector<char> softens_;
};

[[nodiscard]] Symmetric shape_inverse_of(const Particles&, std::size_t row);
/// eps_p, zero where nothing flows.
[[nodiscard]] Symmetric plastic_strain_of(const Particles&, std::size_t row);

[[nodiscard]] Deformation deformation_of(const World&, const ElasticForms&, std::uint32_t id);
[[nodiscard]] Deformation deformation_of(const World&, std::uint32_t id);

struct DeformationEnergy {
  double elastic = 0.0, hourglass = 0.0;  ///< [J]
  [[nodiscard]] double total() const noexcept { return elastic + hourglass; }
};
/// U_i (10) and the hourglass energy of a particle; zero unless it is one of a deformable body.
[[nodiscard]] DeformationEnergy deformation_energy(const World&, const ElasticForms&, std::uint32_t id);
[[nodiscard]] DeformationEnergy deformation_energy(const World&, std::uint32_t id);

/// Orientation of a deformable body: the rotation of the sum of its particles' rotations, weighted by mass. It starts at the
/// identity, and again for a list that freezing has turned into the present frame.
[[nodiscard]] Quaternion orientation_of(const World&, std::size_t body);

}  // namespace tripoint::solid
