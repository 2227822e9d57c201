// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// A half space x > 0 that melts (or freezes) from its surface, which is held at a temperature. This is
/// Neumann's similarity solution, both phases of one density. It is Stefan's where the far temperature is
/// that of the change [Carslaw & Jaeger 1959, section 11.2].
struct NeumannFront {
  double surface = 0.0, change = 0.0, far = 0.0;  ///< temperatures at x = 0, at the front, at rest [K]
  double diffusivity = 0.0;                       ///< k/(rho c_p) of the phase at the surface [m2/s]
  double latent_over_capacity = 0.0;              ///< L/c_p by the phase at the surface [K]
  /// Of the phase that is left, over that of the phase at the surface [1]
  double far_diffusivity_ratio = 1.0;
  double far_conductivity_ratio = 1.0;  ///< likewise [1]

  /// c_p |surface - change| / L.
  [[nodiscard]] double stefan_number() const;
  /// lambda: exp(-l^2)/erf(l) - theta K/sqrt(R) exp(-l^2/R)/erfc(l/sqrt(R)) = sqrt(pi) l / Ste, theta =
  /// (change - far)/(surface - change), R and K the ratios of diffusivity and conductivity.
  [[nodiscard]] double lambda() const;
  /// X = 2 lambda sqrt(D t) [m].
  [[nodiscard]] double front(double time) const;
  /// Temperature at x [m] and time t > 0 [K].
  [[nodiscard]] double temperature(double x, double time) const;
};

}  // namespace tripoint
