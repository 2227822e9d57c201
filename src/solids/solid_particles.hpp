// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "sph/kernels.hpp"
#include "sph/solid.hpp"
#include "state/body_table.hpp"

/// Parts that elasticity, plasticity, fracture and change of phase share: bonds and excluded pairs, and
/// how particles are deformed. Particles are named by id.
namespace tripoint::solid {

/// A bond with this reference vector x_ij = r_i - r_j [m] and its kernel (17); connect() sets its partner.
[[nodiscard]] Bond bond_of(const ElasticityKernel&, const Vec3& x_ij);
/// The kernel (17), with the support scene.bond_reach dx [m].
[[nodiscard]] ElasticityKernel bond_kernel(const Scene&);
/// W of the density kernel: weight of an excluded pair [1/m3] (model 8.2). @param distance of its reference
/// places [m]
[[nodiscard]] double own_weight(const Scene&, double distance);
/// A difference of places [m] as the nearest images have it.
[[nodiscard]] inline Vec3 nearest_image(const PeriodicBox& box, Vec3 d) {
  for (std::size_t a = 0; a < 3; ++a)
    if (box.periodic[a]) d[a] -= box.width[a] * std::round(d[a] / box.width[a]);
  return d;
}
/// r_j - r_i [m] of the nearest images. @param i,j rows
/// @param back a time [s]: places are r - back v, as they were so long before
[[nodiscard]] Vec3 separation(const State&, std::size_t i, std::size_t j, double back = 0.0);

/// Bonds and excluded pairs within each deformable body of the scene, and to bodies that it is joined to.
/// @throws InputError when a periodic direction is too narrow for bonds to be told apart
void connect_solids(State&);

/// Tells of rows whether they are particles of deformable bodies.
class ElasticParticles {
 public:
  explicit ElasticParticles(const State& state) : body_(state.particles[field::body]), is_rigid_(state) {}
  [[nodiscard]] bool operator()(std::size_t row) const { return body_[row] >= 0 && !is_rigid_(row); }

 private:
  std::span<const int> body_;
  RigidMembers is_rigid_;
};

/// Stiffness of a member of a rigid body over that of the elastic partner that it is bonded to [1]. Such
/// members own strain energy too, since the stress on both sides of a cut carries the force. Without theirs
/// the joint bears twice the strain, and gives way as 2.5 spacings more of the bar would. With 1 it gives way
/// as 0.9 spacings would, with 4 as 0.2, with 10 as none (decision 008). As printed, and of matter that
/// melts, flows or breaks, it has 4: what a joint stores there is let go.
inline constexpr double joint_stiffness = 10.0, soft_joint_stiffness = 4.0;

/// Tells of rows whether they own strain energy: particles of deformable bodies, and members of rigid ones
/// that are bonded to such. Valid as the lists were when shapes were last refreshed.
class EnergyOwners {
 public:
  explicit EnergyOwners(const State& state) : stiffness_(state.particles[field::solid_stiffness]) {}
  [[nodiscard]] bool operator()(std::size_t row) const { return stiffness_[row] > 0.0; }

 private:
  std::span<const double> stiffness_;
};

/// Sets the columns that follow from the lists and bodies of these particles (model 8.7). They are volume
/// [m3] and, zero where they own no strain energy, stiffness [1], A_i [1] and rank. For them and their
/// partners it also sets which are regular and, where the scene can freeze, the square of the frequency of
/// each [1/s2].
/// @param first lists are those of the start: no frequency is needed
void refresh_shapes(State&, std::span<const std::uint32_t> ids, bool first = false);

/// How a particle of a deformable body is deformed, by its list and the places of now (model 8.7).
struct Deformation {
  Matrix3 F = identity3;  ///< (14) [1]
  Symmetric P;            ///< projector on the range of M_i [1]
  Symmetric strain;       ///< total, within P [1]
  int rank = 0;           ///< of P: 3 solid, 2 sheet, 1 chain, 0 without neighbours
};

/// Whether the stiffness of this material falls as it melts: marked so, or, printed (Fig. 5), between t_solid
/// and t_melt.
[[nodiscard]] bool softens(const Scene&, const Material&);

/// The scene's forms of elasticity, prepared once. Functions of one particle; `of` reads no column but bonds,
/// volumes and A_i.
class ElasticForms {
 public:
  explicit ElasticForms(const Scene&);
  [[nodiscard]] bool paper() const noexcept { return paper_; }
  /// Coefficient a of the hourglass energy [1], 0 = none.
  [[nodiscard]] double hourglass() const noexcept { return hourglass_; }
  /// Share of the correction for bending that gradients at surfaces have [1], 0 = none.
  [[nodiscard]] double bending() const noexcept { return bending_; }
  /// Constants of particles by rows [Pa], softened where their material softens; zero where they own no
  /// strain energy.
  class Constants {
   public:
    [[nodiscard]] ElasticConstants operator()(std::size_t row) const;
    /// Whether its matter may flow by this elastic strain. Of a solid: whether |dev e| passes the elastic
    /// limit, and by round-off at most where it does not. Of a sheet or chain: whether there is a limit. It
    /// is never false for matter that flows (model 8.8).
    [[nodiscard]] bool may_flow(std::size_t row, int rank, const Symmetric& elastic) const;

   private:
    friend class ElasticForms;
    Constants(const ElasticForms& forms, const State& state);
    const ElasticForms& forms_;
    std::span<const double> stiffness_, share_;
    std::span<const int> material_;
  };
  [[nodiscard]] Constants constants(const State& state) const { return {*this, state}; }
  [[nodiscard]] ElasticConstants constants(const State& state, std::size_t row) const {
    return constants(state)(row);
  }
  /// P of the scene's form [1]. @param shape_inverse A_i [1]   @param rank of it
  [[nodiscard]] Symmetric projector(const Symmetric& shape_inverse, int rank) const;
  /// Strain within P [1] of a particle with this F, green_strain() or strain_paper().
  [[nodiscard]] Symmetric strain(const Matrix3& F, const Symmetric& P, int rank) const;
  /// S [Pa] of the elastic strain P (eps - eps_p) P [1].
  [[nodiscard]] Symmetric stress(const Symmetric& elastic_strain, const Symmetric& P, int rank,
                                 const ElasticConstants&) const;
  /// Factor of v F S d_ij in (12) [1]: 1, printed 2.
  [[nodiscard]] double force_factor() const noexcept { return factor_; }

 private:
  bool paper_;
  double hourglass_, bending_, factor_;
  std::vector<ElasticConstants> constants_;  ///< of each material
  /// Elastic limit squared, infinite where nothing flows; of each material
  std::vector<double> squared_limits_;
  std::vector<char> softens_;
};

inline bool ElasticForms::Constants::may_flow(std::size_t row, int rank, const Symmetric& elastic) const {
  const double limit = forms_.squared_limits_[static_cast<std::size_t>(material_[row])];
  if (rank < 3) return rank != 0 && std::isfinite(limit);
  if (contraction(elastic, elastic) <= limit) return false;  // most: |dev e| <= |e|
  const Symmetric e = deviator(elastic);
  return contraction(e, e) > limit;
}

// The six columns of particles, to be written to where these are not const.
/// A_i [1]
template <class P>
[[nodiscard]] auto shape_inverses(P& p) {
  return symmetric_columns(p, field::shape_inverse);
}
/// Total strain [1]
template <class P>
[[nodiscard]] auto strains(P& p) {
  return symmetric_columns(p, field::strain);
}
/// eps_p [1]. @pre the scene has plastic flow
template <class P>
[[nodiscard]] auto plastic_strains(P& p) {
  return symmetric_columns(p, field::plastic_strain);
}
/// A_i [1]
[[nodiscard]] Symmetric shape_inverse_of(const Particles&, std::size_t row);
/// eps_p [1], zero where nothing flows.
[[nodiscard]] Symmetric plastic_strain_of(const Particles&, std::size_t row);
/// To be called where the scene has plastic flow only.
void set_plastic_strain(Particles&, std::size_t row, const Symmetric&);
/// Total strain as the elastic effect last found it [1].
[[nodiscard]] Symmetric strain_of(const Particles&, std::size_t row);

/// F, P and strain of one particle by (14). @param back as separation() has it [s]
[[nodiscard]] Deformation deformation_of(const State&, const ElasticForms&, std::uint32_t id,
                                         double back = 0.0);
[[nodiscard]] Deformation deformation_of(const State&, std::uint32_t id);

/// Energy that one particle stores by its deformation.
struct DeformationEnergy {
  double elastic = 0.0, hourglass = 0.0;  ///< [J]
  [[nodiscard]] double total() const noexcept { return elastic + hourglass; }
};
/// U_i (10) and the hourglass energy of a particle [J] (model 8.7); zero unless it owns some. @param back as
/// separation() has it [s]
[[nodiscard]] DeformationEnergy deformation_energy(const State&, const ElasticForms&, std::uint32_t id,
                                                   double back = 0.0);
[[nodiscard]] DeformationEnergy deformation_energy(const State&, std::uint32_t id);

/// Orientation of a deformable body: the rotation of the sum of its particles' rotations, weighted by mass.
/// It starts at the identity, and again for a list that freezing has turned into the present frame.
[[nodiscard]] Quaternion orientation_of(const State&, std::size_t body);

}  // namespace tripoint::solid
