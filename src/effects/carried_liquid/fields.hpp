// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/fields.hpp"

/// Fields of the liquid that carries its density. G = grad_i W = (-W'/r) d, d = r_j - r_i.
namespace tripoint::field {

inline constexpr Field<double> impedance{"impedance", "Pa s/m"};   ///< rho0 c of a liquid, 0 of a solid
inline constexpr Field<double> exposed{"exposed", "1"};            ///< 1 at a free surface, else 0
inline constexpr Field<double> exposed_near{"exposed_near", "1"};  ///< 1 where a neighbour is exposed
/// sum V d (x) G over all neighbours, and over those of the same liquid.
inline constexpr Field<double> moment_xx{"moment.xx", "1"}, moment_yy{"moment.yy", "1"},
    moment_zz{"moment.zz", "1"}, moment_yz{"moment.yz", "1"}, moment_xz{"moment.xz", "1"},
    moment_xy{"moment.xy", "1"};
inline constexpr SymmetricField moment{moment_xx, moment_yy, moment_zz, moment_yz, moment_xz, moment_xy};
inline constexpr Field<double> own_moment_xx{"own_moment.xx", "1"}, own_moment_yy{"own_moment.yy", "1"},
    own_moment_zz{"own_moment.zz", "1"}, own_moment_yz{"own_moment.yz", "1"},
    own_moment_xz{"own_moment.xz", "1"}, own_moment_xy{"own_moment.xy", "1"};
inline constexpr SymmetricField own_moment{own_moment_xx, own_moment_yy, own_moment_zz,
                                           own_moment_yz, own_moment_xz, own_moment_xy};
inline constexpr Field<double> wall_share{"wall_share", "1"};  ///< sum V W over solids
/// With which solids push out what lies within them
inline constexpr Field<double> wall_pressure{"wall_pressure", "Pa"};
/// B, the inverse of the moment, blended into the identity where neighbours are few.
inline constexpr Field<double> correction_xx{"correction.xx", "1"}, correction_yy{"correction.yy", "1"},
    correction_zz{"correction.zz", "1"}, correction_yz{"correction.yz", "1"},
    correction_xz{"correction.xz", "1"}, correction_xy{"correction.xy", "1"};
inline constexpr SymmetricField correction{correction_xx, correction_yy, correction_zz,
                                           correction_yz, correction_xz, correction_xy};
inline constexpr Field<double> velocity_gradient_xx{"velocity_gradient.xx", "1/s"},
    velocity_gradient_xy{"velocity_gradient.xy", "1/s"}, velocity_gradient_xz{"velocity_gradient.xz", "1/s"},
    velocity_gradient_yx{"velocity_gradient.yx", "1/s"}, velocity_gradient_yy{"velocity_gradient.yy", "1/s"},
    velocity_gradient_yz{"velocity_gradient.yz", "1/s"}, velocity_gradient_zx{"velocity_gradient.zx", "1/s"},
    velocity_gradient_zy{"velocity_gradient.zy", "1/s"}, velocity_gradient_zz{"velocity_gradient.zz", "1/s"};
inline constexpr MatrixField velocity_gradient{
    velocity_gradient_xx, velocity_gradient_xy, velocity_gradient_xz,
    velocity_gradient_yx, velocity_gradient_yy, velocity_gradient_yz,
    velocity_gradient_zx, velocity_gradient_zy, velocity_gradient_zz};
inline constexpr Field<double> density_gradient_x{"density_gradient.x", "kg/m4"},
    density_gradient_y{"density_gradient.y", "kg/m4"}, density_gradient_z{"density_gradient.z", "kg/m4"};
inline constexpr VectorField<double> density_gradient{density_gradient_x, density_gradient_y,
                                                      density_gradient_z};
/// Force over volume of a uniform pressure of 1: 0 where particles are spread evenly.
inline constexpr Field<double> unevenness_x{"unevenness.x", "1/m"}, unevenness_y{"unevenness.y", "1/m"},
    unevenness_z{"unevenness.z", "1/m"};
inline constexpr VectorField<double> unevenness{unevenness_x, unevenness_y, unevenness_z};
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
inline constexpr Field<double> pull_x{"pull.x", "m/s2"}, pull_y{"pull.y", "m/s2"}, pull_z{"pull.z", "m/s2"};
inline constexpr VectorField<double> pull{pull_x, pull_y, pull_z};
inline constexpr Field<double> liquid_viscosity{"liquid_viscosity", "Pa s"};
inline constexpr Field<double> liquid_rest_density{"liquid_rest_density", "kg/m3"};
inline constexpr Field<double> slips{"slips", "1"};  ///< 1 where liquid slips along this solid
inline constexpr Field<double> predicted_x{"predicted_velocity.x", "m/s"},
    predicted_y{"predicted_velocity.y", "m/s"}, predicted_z{"predicted_velocity.z", "m/s"};
inline constexpr VectorField<double> predicted{predicted_x, predicted_y, predicted_z};
/// m/rho of a liquid, m/rho0 of a solid
inline constexpr Field<double> carried_volume{"carried_volume", "m3"};
/// Force of the viscosity of the residue: numerical.
inline constexpr Field<double> residue_force_x{"residue_force.x", "N"},
    residue_force_y{"residue_force.y", "N"}, residue_force_z{"residue_force.z", "N"};
inline constexpr VectorField<double> residue_force{residue_force_x, residue_force_y, residue_force_z};
/// p V B, of which a step of sound takes its forces.
inline constexpr Field<double> stress_xx{"stress.xx", "J"}, stress_yy{"stress.yy", "J"},
    stress_zz{"stress.zz", "J"}, stress_yz{"stress.yz", "J"}, stress_xz{"stress.xz", "J"},
    stress_xy{"stress.xy", "J"};
inline constexpr SymmetricField stress{stress_xx, stress_yy, stress_zz, stress_yz, stress_xz, stress_xy};
inline constexpr Field<double> summed_density{"summed_density", "1/m3"};

}  // namespace tripoint::field
