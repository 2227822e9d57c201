// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/field.hpp"

/// Fields of heat (21) that no other effect knows.
namespace tripoint::field {

inline constexpr Field<double> temperature_rate{"temperature_rate", "K/s"};
inline constexpr Field<double> heat_rate{"heat_rate", "W"}, heat_rate_before{"heat_rate.before", "W"};
inline constexpr Field<double> surface_flow_before{"surface_flow.before", "W"};
inline constexpr Field<double> conductivity{"conductivity", "W/m/K"}, diffusivity{"diffusivity", "m2/s"};
inline constexpr Field<double> rest_volume{"rest_volume", "m3"};
/// sum_j G_ij, the conductance of i to its neighbours: bounds the time step.
inline constexpr Field<double> conductance{"conductance", "W/K"};
/// sum_j of the coefficients of T_j - T_i in (21) as printed: bounds the time step.
inline constexpr Field<double> exchange{"exchange", "1/s"};
/// B_i of model 8.6: symmetric, six components.
inline constexpr Field<double> moment_inverse_xx{"moment_inverse.xx", "1"},
    moment_inverse_yy{"moment_inverse.yy", "1"}, moment_inverse_zz{"moment_inverse.zz", "1"};
inline constexpr Field<double> moment_inverse_yz{"moment_inverse.yz", "1"},
    moment_inverse_xz{"moment_inverse.xz", "1"}, moment_inverse_xy{"moment_inverse.xy", "1"};
inline constexpr SymmetricField moment_inverse{moment_inverse_xx, moment_inverse_yy, moment_inverse_zz,
                                               moment_inverse_yz, moment_inverse_xz, moment_inverse_xy};
/// Sums that B_i is made of, 15 components of Q_i and S_i (ConductionSums).
inline constexpr Field<double> spread_xx{"spread.xx", "1"}, spread_yy{"spread.yy", "1"},
    spread_zz{"spread.zz", "1"}, spread_yz{"spread.yz", "1"}, spread_xz{"spread.xz", "1"},
    spread_xy{"spread.xy", "1"};
inline constexpr SymmetricField spread{spread_xx, spread_yy, spread_zz, spread_yz, spread_xz, spread_xy};
inline constexpr Field<double> spread_rest_xx{"spread_rest.xx", "1"}, spread_rest_xy{"spread_rest.xy", "1"},
    spread_rest_xz{"spread_rest.xz", "1"}, spread_rest_yx{"spread_rest.yx", "1"},
    spread_rest_yy{"spread_rest.yy", "1"}, spread_rest_yz{"spread_rest.yz", "1"},
    spread_rest_zx{"spread_rest.zx", "1"}, spread_rest_zy{"spread_rest.zy", "1"},
    spread_rest_zz{"spread_rest.zz", "1"};
inline constexpr MatrixField spread_rest{spread_rest_xx, spread_rest_xy, spread_rest_xz,
                                         spread_rest_yx, spread_rest_yy, spread_rest_yz,
                                         spread_rest_zx, spread_rest_zy, spread_rest_zz};
inline constexpr Field<double> lean_x{"lean.x", "1/m"}, lean_y{"lean.y", "1/m"}, lean_z{"lean.z", "1/m"};
inline constexpr VectorField<double> lean{lean_x, lean_y, lean_z};

}  // namespace tripoint::field
