// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

namespace tripoint {

/// An estimate with its 95 % interval; without degrees of freedom the interval is infinite.
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// |e| = C h^p, least squares in log space.
struct PowerLaw {
  Estimate order;
  double coefficient = 0.0;
  double residual = 0.0;  ///< sum of squared residuals of ln |e|
};
[[nodiscard]] PowerLaw fit_power_law(const std::vector<double>& h, const std::vector<double>& e);

/// e = floor + C h^p, signed, least squares of the residuals relative to |e|: p by a scan, floor and C by
/// linear least squares.
struct FlooredPowerLaw {
  Estimate order, floor;
  double coefficient = 0.0;
  double residual = 0.0;  ///< sum of squared relative residuals
  /// At least four levels and a least sum away from the ends of the scan, p in 0.2..8
  bool found = false;
};
[[nodiscard]] FlooredPowerLaw fit_floored_power_law(const std::vector<double>& h,
                                                    const std::vector<double>& e);

/// Corrected Akaike criterion of a fit with `parameters`; where n - parameters - 1 <= 0 the correction does
/// not exist and is left out.
[[nodiscard]] double akaike(double residual, std::size_t n, std::size_t parameters);

/// Student's t of a two-sided 95 % interval; infinite without degrees of freedom.
[[nodiscard]] double student_95(int degrees_of_freedom);

}  // namespace tripoint
