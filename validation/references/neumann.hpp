// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// A half space x > 0 that melts (or freezes) from its surface, which is held at a temperature: Neumann's similarity solution for equal properties
/// of both phases, Stefan's where the far temperature is that of the change [Carslaw & Jaeger 1959, section 11.2].
struct NeumannFront {
  double surface = 0.0, change = 0.0, far = 0.0;  ///< temperatures at x = 0, at the front, at rest [K]
  double diffusivity = 0.0;                       ///< k/(rho c_p) [m2/s]
  double latent_over_capacity = 0.0;              ///< L/c_p [K]

  /// c_p |surface - change| / L.
  [[nodiscard]] double stefan_number() const;
  /// lambda: exp(-l^2)/erf(l) - theta exp(-l^2)/erfc(l) = sqrt(pi) l / Ste, theta = (change - far)/(surface - change).
  [[nodiscard]] double lambda() const;
  /// X = 2 lambda sqrt(D t) [m].
  [[nodiscard]] double front(double time) const;
  /// Temperature at x [m] and time t > 0 [K].
  [[nodiscard]] double temperature(double x, double time) const;
};

}  // namespace tripoint
