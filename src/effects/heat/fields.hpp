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
inline constexpr SymmetricField moment_inverse{"moment_inverse", "1"};
/// Sums that B_i is made of, 15 components of Q_i and S_i (ConductionSums).
inline constexpr SymmetricField spread{"spread", "1"};
inline constexpr MatrixField spread_rest{"spread_rest", "1"};
inline constexpr VectorField<double> lean{"lean", "1/m"};

}  // namespace tripoint::field
