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
/// Mean of those at both ends of the drift.
inline constexpr SymmetricField correction_halfway{"correction_halfway", "1"};
inline constexpr MatrixField velocity_gradient{"velocity_gradient", "1/s"};
/// Symmetric part of the gradient of velocity.
inline constexpr SymmetricField strain_rate{"strain_rate", "1/s"};
inline constexpr VectorField<double> pressure_gradient{"pressure_gradient", "Pa/m"};
/// Force over volume of a uniform pressure of 1: 0 where particles are spread evenly.
inline constexpr VectorField<double> unevenness{"unevenness", "1/m"};
/// Greatest square of a velocity difference
inline constexpr Field<double> nearby_speed2{"nearby_speed2", "m2/s2"};
/// Of the velocity, by the form's own pair amid the drift
inline constexpr Field<double> divergence{"divergence", "1/s"};
/// Sum of the density diffusion, before its coefficient
inline constexpr Field<double> diffused{"diffused", "Pa/m2"};
inline constexpr Field<double> touching{"touching", "1"};  ///< sum V W over liquids, of a solid
inline constexpr Field<double> touching_halfway{"touching_halfway", "1"};  ///< the same amid the drift
inline constexpr Field<double> pressed{"pressed", "Pa"};  ///< sum V W p over liquids, of a solid
inline constexpr Field<double> weighed{"weighed", "Pa"};  ///< -sum V W rho g.d over liquids, of a solid
/// Of a solid: V div v over `touching`, 0 where it has no pressure
inline constexpr Field<double> displaced{"displaced", "m3/s"};
inline constexpr Field<double> wall_rate{"wall_rate", "1/s"};  ///< what solids add to the divergence
/// Rate of strain of an elastic particle amid the drift, 0 of all else
inline constexpr SymmetricField face_rate{"face_rate", "1/s"};
/// Of an elastic particle: sum of f (x) d over liquids, f the force of pressure on it
inline constexpr SymmetricField face_load{"face_load", "J"};
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
/// Of the number density, at the last renewal, without the own kernel; and its slope.
inline constexpr Field<double> summed_density{"summed_density", "1/m3"};
inline constexpr VectorField<double> summed_slope{"summed_slope", "1/m4"};
/// Compression of a liquid by its pressure at the start, where its places are those of no pressure
inline constexpr Field<double> compression_at_start{"compression_at_start", "1"};

}  // namespace tripoint::field
