// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/vec3.hpp"

namespace tripoint {

/// Rate over diffusivity [1/m2] at which the SPH conduction operator of the paper, (21) with the summed
/// density (4), damps the mode cos(k.r). The lattice, cubic or its layer of x and z, is unbounded, and time
/// is continuous:
///   sum_j (dx^3/S0) lapW_visc(r_j) (1 - cos k.r_j),  S0 = sum_j W_poly6(r_j) dx^3 with j = 0 in it.
/// A lattice mode is an eigenvector, so this is exact, not a first-order estimate. Written apart from src/sph
/// on purpose.
/// @param spacing dx [m]   @param support h [m], W = 0 for r >= h
[[nodiscard]] double paper_lattice_damping(const Vec3& wave_vector, double spacing, double support,
                                           bool planar = false);

/// Likewise for the corrected form (model, 8.6) with rest volumes dx^3 and Wendland C2:
///   (1/M) sum_j V K(r_j) (1 - cos k.r_j),  K = -2 W'/r,  M = (1/2) sum_j V K x_j^2 (the moment matrix is M
///   times the unit one here).
[[nodiscard]] double corrected_lattice_damping(const Vec3& wave_vector, double spacing, double support,
                                               bool planar = false);

}  // namespace tripoint
