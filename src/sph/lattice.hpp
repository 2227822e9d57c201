// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "core/vec3.hpp"
#include "sph/kernels.hpp"

/// Sums over the cubic lattice, or over its layer y = 0: the values of a kernel on undisturbed particles,
/// exact at any number of them. Lengths are in spacings where nothing else is said, so that the support
/// radius is the support ratio q = h/dx. Proof: tests/sph/lattice_test.cpp.
namespace tripoint {

/// Moments of a kernel on the lattice [1], V of a cell. The ideal of `density`, `gradient` and `laplacian`
/// is 1; a moment of which the kernel's form in the solver makes no use stays 0.
struct LatticeMoments {
  int neighbours = 0;      ///< with 0 < r < h
  double density = 0.0;    ///< S0 = sum_j V W, the particle itself included
  double layer = 0.0;      ///< S_layer, the part of S0 that the plane through the particle gives
  double gradient = 0.0;   ///< M = -1/d sum_j V r W'(r), d dimensions; also that of the Laplacian -2 W'/r
  double laplacian = 0.0;  ///< 1/(2 d) sum_j V r^2 lap W
};

// Moments of each kernel of kernels.hpp. @param q support ratio, > 0 [spacings]
[[nodiscard]] LatticeMoments poly6_moments(double q, Dimensions = Dimensions::three);  ///< density, layer
[[nodiscard]] LatticeMoments spiky_moments(double q,
                                           Dimensions = Dimensions::three);  ///< density, layer, gradient
[[nodiscard]] LatticeMoments viscosity_moments(double q, Dimensions = Dimensions::three);  ///< laplacian
[[nodiscard]] LatticeMoments elasticity_moments(
    double q, Dimensions = Dimensions::three);  ///< density, layer, gradient
[[nodiscard]] LatticeMoments wendland_moments(double q,
                                              Dimensions = Dimensions::three);  ///< density, layer, gradient

/// Sums of the Wendland kernel over the lattice under a flat surface.
struct LatticeLayer {
  double sum = 0.0;    ///< S over S0 inside [1]
  double slope = 0.0;  ///< h |grad S|/S [1]
};
/// @param q support ratio, > 1 [spacings]   @param above layers between the particle and the surface
[[nodiscard]] LatticeLayer layer_under_surface(double q, int above, Dimensions = Dimensions::three);

/// How much the lattice resists shear by `central` viscosity, over the exact resistance [1] (model 8.5).
struct ShearModuli {
  double axes = 0.0;       ///< along its axes: velocity along x, changing along y
  double diagonals = 0.0;  ///< along the diagonals of its faces
};
/// @param q support ratio, > 1 [spacings]   @param weight of pairs, its square [1/spacing2]
[[nodiscard]] ShearModuli shear_moduli(double q, const ShearWeight& weight, Dimensions = Dimensions::three);

/// The weight with which both moduli are 1 (model 8.5). A constant below 0 would drive near pairs in the
/// place of braking them. Where the two conditions ask for a constant below 0, it is 0. The moduli then
/// differ as little as they can, and their mean over all directions is 1.
/// @param q support ratio, > 1.5 [spacings]   @return its square [1/spacing2]
[[nodiscard]] ShearWeight isotropic_shear(double q, Dimensions = Dimensions::three);

/// Kernel (constant + square r^2) W of the energy that pairs of unlike liquids have (model 8.3).
struct InterfaceKernel {
  double constant = 0.0, square = 0.0;  ///< [1], [1/m2]
  /// K(r) [1/m3]. @param W at the scene's support   @param r distance, r >= 0 [m]
  [[nodiscard]] double value(const WendlandC2& W, double r) const noexcept {
    return (constant + square * (r * r)) * W.value(r);
  }
  /// K'(r)/r [1/m5]
  [[nodiscard]] double derivative_over_r(const WendlandC2& W, double r) const noexcept {
    return (constant + square * (r * r)) * W.derivative_over_r(r) + 2.0 * square * W.value(r);
  }
};

/// The kernel, at spacing 1, that keeps the two lattice layers nearest to a flat interface at rest under the
/// exact pressures. In a pair each liquid presses on the other with the mean of the two pressures. A layer at
/// distance a from the interface sees layers of the other liquid at distances n > a. Each of these takes the
/// difference of the densities times (n - a) k_n/M from its weight, k_n = -sum W' z/r over that layer. The
/// energy gives back half the difference times (n k'_n - K_n)/M, where K_n = sum K and k' is k of K. @param q
/// support ratio [spacings], above 2: else a second layer sees nothing, and the square is 0
/// @return its square [1/spacing2]
[[nodiscard]] InterfaceKernel interface_kernel(double q, Dimensions = Dimensions::three);

/// Decay rate over diffusivity of the mode cos(k.r) under (21) as printed, on the cubic lattice:
/// sum_j V lapW_visc(r_j) (1 - cos k.r_j) [1/m2]. V = dx^3/S0 of poly6 is the volume m/rho that (4) gives.
/// Times the diffusivity [m2/s] it is the rate of decay in continuous time [1/s].
/// @param spacing dx > 0 [m]   @param support h > dx [m]   @param wave_vector k [1/m]
[[nodiscard]] double paper_heat_rate(double spacing, double support, const Vec3& wave_vector);

}  // namespace tripoint
