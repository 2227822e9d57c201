// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/neumann.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tripoint {

double NeumannFront::stefan_number() const { return std::abs(surface - change) / latent_over_capacity; }

double NeumannFront::lambda() const {
  const double theta = (change - far) / (surface - change),
               slope = std::sqrt(std::numbers::pi) / stefan_number();
  const double r = 1.0 / std::sqrt(far_diffusivity_ratio);
  const auto taken = [&](double l) {
    return theta == 0.0 ? 0.0
                        : theta * far_conductivity_ratio * r * std::exp(-l * l * r * r) / std::erfc(l * r);
  };  // by the phase beyond the front
  const auto residual = [&](double l) { return std::exp(-l * l) / std::erf(l) - taken(l) - slope * l; };
  double low = 1e-12,
         // Erfc is above the smallest number there; falls from infinity to below 0 between them
      high = std::min(8.0, 20.0 / r);
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (residual(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double NeumannFront::front(double time) const { return 2.0 * lambda() * std::sqrt(diffusivity * time); }

double NeumannFront::temperature(double x, double time) const {
  const double l = lambda(), s = 0.5 * x / std::sqrt(diffusivity * time),
               r = 1.0 / std::sqrt(far_diffusivity_ratio);
  return s < l ? surface + (change - surface) * std::erf(s) / std::erf(l)
               : far + (change - far) * std::erfc(s * r) / std::erfc(l * r);
}

}  // namespace tripoint
