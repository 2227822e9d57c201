// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/fields.hpp"

/// Fields of the liquid that carries its density. G = grad_i W = (-W'/r) d, d = r_j - r_i.
namespace tripoint::field {

inline constexpr Field<double> impedance{"impedance", "Pa s/m"};   ///< rho0 c of a liquid, 0 of a solid
inline constexpr Field<double> exposed{"exposed", "1"};            ///< 1 at a free surface, else 0
inline constexpr Field<double> exposed_near{"exposed_near", "1"};  ///< 1 where a neighbour is exposed
/// sum V d (x) G over all neighbours, and over those of the same liquid.
inline constexpr SymmetricField moment{"moment", "1"};
inline constexpr SymmetricField own_moment{"own_moment", "1"};
inline constexpr Field<double> wall_share{"wall_share", "1"};  ///< sum V W over solids
/// With which solids push out what lies within them
inline constexpr Field<double> wall_pressure{"wall_pressure", "Pa"};
/// B, the inverse of the moment, blended into the identity where neighbours are few.
inline constexpr SymmetricField correction{"correction", "1"};
inline constexpr MatrixField velocity_gradient{"velocity_gradient", "1/s"};
/// Symmetric part of the gradient of velocity.
inline constexpr SymmetricField strain_rate{"strain_rate", "1/s"};
inline constexpr VectorField<double> density_gradient{"density_gradient", "kg/m4"};
/// Force over volume of a uniform pressure of 1: 0 where particles are spread evenly.
inline constexpr VectorField<double> unevenness{"unevenness", "1/m"};
/// Greatest square of a velocity difference
inline constexpr Field<double> nearby_speed2{"nearby_speed2", "m2/s2"};
/// Of the velocity, by the form's own pair
inline constexpr Field<double> divergence{"divergence", "1/s"};
/// Sum of the density diffusion, before its coefficient
inline constexpr Field<double> diffused{"diffused", "kg/m5"};
/// Of a solid: by how much the liquid that touches it has pressed it, p_s = modulus squeeze; -1 before the
/// start is known.
inline constexpr Field<double> squeeze{"squeeze", "1"};
inline constexpr Field<double> touching{"touching", "1"};  ///< sum V W over liquids, of a solid
inline constexpr Field<double> pressed{"pressed", "Pa"};   ///< sum V W (p - rho g.d) over liquids, of a solid
/// Of liquids and of what they touch
inline constexpr Field<double> carried_pressure{"carried_pressure", "Pa"};
/// Gravity at a solid; 0 of liquids.
inline constexpr VectorField<double> pull{"pull", "m/s2"};
inline constexpr Field<double> liquid_viscosity{"liquid_viscosity", "Pa s"};
inline constexpr Field<double> liquid_rest_density{"liquid_rest_density", "kg/m3"};
inline constexpr Field<double> slips{"slips", "1"};  ///< 1 where liquid slips along this solid
inline constexpr VectorField<double> predicted{"predicted_velocity", "m/s"};
/// m/rho of a liquid, m/rho0 of a solid
inline constexpr Field<double> carried_volume{"carried_volume", "m3"};
/// Force of the viscosity of the residue: numerical.
inline constexpr VectorField<double> residue_force{"residue_force", "N"};
/// p V B, of which a step of sound takes its forces.
inline constexpr SymmetricField stress{"stress", "J"};
inline constexpr Field<double> summed_density{"summed_density", "1/m3"};
inline constexpr VectorField<double> summed_slope{"summed_slope", "1/m4"};

}  // namespace tripoint::field
