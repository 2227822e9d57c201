// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

#include "tables/words.hpp"

namespace tripoint {

/// Support of the sides of a stretched bar: nothing, one direction (the other free), or both.
enum class BarSides { free, plane_strain, confined };
constexpr WordTable<3> word_table(BarSides) {
  return {"hold of a bar's sides", {"free", "plane_strain", "confined"}};
}

/// Reference stretch of a homogeneous bar: St Venant-Kirchhoff's S = C : (E - E_p) in Green strain. Von Mises
/// flow holds at |dev(E - E_p)| = g1, |E_p| <= g2 (model 8.7, 8.8). The printed form is the same law in the
/// strain F^T F - I, with the gradient that the lattice sees.
struct BarLaw {
  double young = 0.0, poisson_ratio = 0.0;  ///< [Pa], [1]
  BarSides sides = BarSides::free;
  double elastic_limit = std::numeric_limits<double>::infinity();  ///< g1
  double plastic_limit = std::numeric_limits<double>::infinity();  ///< g2
  /// Strain = this (F^2 - 1): 1/2, as printed 1
  double strain_factor = 0.5;
  double moment = 1.0;  ///< M: F - 1 = M (stretch - 1); as printed the lattice's gradient moment
  double volume = 1.0;  ///< body volume of a particle over dx^3; as printed (11)

  /// Stiffness along the bar at small strain without its factors: E; E/(1 - nu^2); E (1 - nu)/((1 + nu)(1 - 2
  /// nu)) [Pa].
  [[nodiscard]] double stiffness() const;
  /// Modulus that the reaction shows at small strain [Pa]: the stiffness; as printed 4 M^2 times it, times
  /// the volume.
  [[nodiscard]] double modulus() const {
    return volume * 4.0 * strain_factor * strain_factor * moment * moment * stiffness();
  }
  /// Yield stress in uniaxial tension, sqrt(6) mu g1 [Pa].
  [[nodiscard]] double yield_stress() const;
};

/// State of the bar, per reference volume.
struct BarState {
  double stretch = 1.0;
  double plastic = 0.0;     ///< component of E_p along the bar
  double force = 0.0;       ///< over the reference cross-section [Pa], tension positive
  double elastic = 0.0;     ///< stored energy [J/m3]
  double dissipated = 0.0;  ///< by plastic flow [J/m3]
};

/// The state after a monotone change of stretch: perfect plasticity is a play operator, exact over any length
/// of it.
/// @throws InputError for yielding in plane strain, which has no such closed form
[[nodiscard]] BarState stretched(const BarLaw&, const BarState&, double stretch);

/// The stretch at which the force comes back to zero from a state [1].
[[nodiscard]] double unloaded_stretch(const BarLaw&, const BarState&);

/// Gradient moment M and body volume v/dx^3 of the elasticity kernel (17) with (11) on the unbounded cubic
/// lattice.
/// @param support_ratio h/dx, above 1
struct LatticeFactors {
  double moment = 1.0, volume = 1.0;
};
[[nodiscard]] LatticeFactors elastic_lattice_factors(double support_ratio);

}  // namespace tripoint
