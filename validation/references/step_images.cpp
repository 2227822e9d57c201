// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/step_images.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

/// Integral of erf(x/s) over x [m].
double erf_integral(double x, double s) {
  return x * std::erf(x / s) + s * std::exp(-x * x / (s * s)) / std::sqrt(std::numbers::pi);
}

/// erf(x/s), or its mean over a cell.
double smooth_sign(double x, double cell, double s) {
  if (cell <= 0.0) return std::erf(x / s);
  return (erf_integral(x + 0.5 * cell, s) - erf_integral(x - 0.5 * cell, s)) / cell;
}

double sharp(const StepImages& step, double x, double cell) {
  if (cell <= 0.0) return x < step.place ? 1.0 : 0.0;
  return std::clamp((step.place - (x - 0.5 * cell)) / cell, 0.0, 1.0);
}

}  // namespace

double share_of_low_side(const StepImages& step, double x, double cell, double time) {
  if (time <= 0.0) return sharp(step, x, cell);
  const double L = step.bar.length(), s = std::sqrt(4.0 * step.diffusivity * time);
  const double period = step.bar.periodic ? L : 2.0 * L;
  const double from = step.bar.periodic ? step.bar.low : 2.0 * step.bar.low - step.place;
  const int images = 2 + static_cast<int>(std::ceil(6.5 * s / period));  // erf(6.5) differs from 1 by 4e-20
  double sum = 0.0;
  for (int n = -images; n <= images; ++n)
    sum += 0.5 *
           (smooth_sign(x - from + n * period, cell, s) - smooth_sign(x - step.place + n * period, cell, s));
  return sum;
}

}  // namespace tripoint
