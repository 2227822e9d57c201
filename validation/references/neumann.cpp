// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/neumann.hpp"

#include <cmath>
#include <numbers>

namespace tripoint {

double NeumannFront::stefan_number() const { return std::abs(surface - change) / latent_over_capacity; }

double NeumannFront::lambda() const {
  const double theta = (change - far) / (surface - change), slope = std::sqrt(std::numbers::pi) / stefan_number();
  const auto residual = [&](double l) { return std::exp(-l * l) * (1.0 / std::erf(l) - theta / std::erfc(l)) - slope * l; };
  double low = 1e-12, high = 8.0;  // falls from infinity to below 0 between them
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    (residual(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double NeumannFront::front(double time) const { return 2.0 * lambda() * std::sqrt(diffusivity * time); }

double NeumannFront::temperature(double x, double time) const {
  const double l = lambda(), s = 0.5 * x / std::sqrt(diffusivity * time);
  return s < l ? surface + (change - surface) * std::erf(s) / std::erf(l) : far + (change - far) * std::erfc(s) / std::erfc(l);
}

}  // namespace tripoint
