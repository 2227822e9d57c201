// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "core/matrix3.hpp"
#include "liquids/listed_pairs.hpp"
#include "sph/kernels.hpp"
#include "state/state.hpp"

namespace tripoint::faces {

/// Pressure acts at the face of an elastic solid (model 8.3). The force of a pair acts between the centres of
/// two particles. Without a correction the half of the distance that lies within the solid would not be
/// loaded. So this half is measured in the solid's reference shape: r*^2 = d.(I + D_i + D_j) d, d = r_j -
/// r_i. D = s/2 (F^-T F^-1 - I), 0 for matter that is not elastic, s = scene.face_pressure. The energies of
/// compression are those at r*, and their change with F is a load on the bonds of the solid. The pair passes
/// see r; the difference due to r* is added after them.
class FacePressure {
 public:
  explicit FacePressure(const Scene&);
  [[nodiscard]] bool acts() const noexcept { return share_ > 0.0; }
  /// After the pass of densities: W(r*) - W(r) to both particles of each pair with an elastic one.
  void add_densities(State&, const PairKernels&);
  /// After the pass of rates: the same to the pressure force, and dU/dF of each elastic particle to its
  /// bonds.
  void add_forces(State&, const Rows&);
  /// Rows, groups or bodies have changed: look again which particles are elastic.
  void clear() { pairs_.clear(); }

 private:
  /// One that acts, at the present places.
  struct Near {
    std::uint32_t row;
    Vec3 d;                ///< r_j - r_i [m]
    double at_face, here;  ///< W'(r*)/r*, W'(r)/r [1/m5]
  };
  void find(const State&);
  void deform(State&);
  std::vector<char> find_pressed(const State&);
  void find_bonded(const State&, const std::vector<char>& pressed);
  /// (I + D_i + D_j) d. @param i,j ids
  [[nodiscard]] Vec3 seen_at_face(std::size_t i, std::size_t j, const Vec3& d) const {
    return d + (measure_[i] + measure_[j]) * d;
  }

  double share_;  ///< s
  /// Of each row, 1 where it is a solid of rank 3 that moves by its own particles
  std::vector<char> elastic_;
  liquid::ListedPairs<> pairs_;        ///< of which one is elastic
  std::vector<Near> near_;             ///< those of a listed row n from pairs_.first(n) on
  std::vector<std::size_t> acting_;    ///< how many of each listed row
  std::vector<std::uint32_t> bonded_;  ///< rows with bonds to such elastic ones, or such themselves
  std::vector<Matrix3> inverse_;       ///< by row, F^-1 of the elastic ones
  std::vector<Symmetric> measure_;     ///< by id, D
  std::vector<Matrix3> load_;          ///< by id, dU/dF A_i [J]
};

}  // namespace tripoint::faces
