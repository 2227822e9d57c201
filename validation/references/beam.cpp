// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/beam.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "core/errors.hpp"

namespace tripoint {
namespace {

/// exp(A) by its series on A / 2^n, squared n times; |A| / 2^n < 1/8 makes 14 terms exact to round-off.
Eigen::Matrix4d exponential(const Eigen::Matrix4d& A) {
  const int n =
      std::max(0, static_cast<int>(std::ceil(std::log2(A.cwiseAbs().rowwise().sum().maxCoeff()))) + 3);
  const Eigen::Matrix4d a = A / std::pow(2.0, n);
  Eigen::Matrix4d sum = Eigen::Matrix4d::Identity(), term = Eigen::Matrix4d::Identity();
  for (int k = 1; k <= 14; ++k) {
    term = term * a / k;
    sum += term;
  }
  for (int k = 0; k < n; ++k) sum = sum * sum;
  return sum;
}

/// Residual of the end conditions at angular frequency w, 1 for w = 0. State (w/L, psi, M L/(EI), V L^2/(EI))
/// over x/L, so that all entries are of order 1. It follows w' = psi + V/(kappa G A), psi' = M/(EI), M' = -V
/// - rho I w^2 psi, V' = -rho A w^2 w.
double determinant(const Beam& b, const BeamTip& tip, double w) {
  const double L = b.length, L2 = L * L, stiffness = b.bending, w2 = w * w;
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A(0, 1) = 1.0;
  A(0, 3) = stiffness / (b.shear * L2);
  A(1, 2) = 1.0;
  A(2, 3) = -1.0;
  A(2, 1) = -b.rotary * w2 * L2 / stiffness;
  A(3, 0) = -b.mass * w2 * L2 * L2 / stiffness;
  const Eigen::Matrix4d T = exponential(A);
  // A rigid tip: V = m w^2 (w + d psi), M = J w^2 psi + d V.
  const double m = tip.mass * w2 * L2 * L / stiffness, J = tip.inertia * w2 * L / stiffness,
               d = tip.offset / L;
  const Eigen::RowVector4d force(-m, -m * d, 0.0, 1.0), moment(0.0, -J, 1.0, -d);
  const Eigen::Matrix<double, 4, 2> clamped = T.rightCols<2>();  // w = psi = 0 at x = 0
  Eigen::Matrix2d end;
  end << moment * clamped, force * clamped;
  return end.determinant();
}

}  // namespace

BeamPoint beam_sag(const Beam& b, const BeamTip& tip, double gravity, double x) {
  const double q = b.mass * gravity, P = tip.mass * gravity, L = b.length, arm = L + tip.offset;
  const double rotation =
      (0.5 * q * (L * L * x - L * x * x + x * x * x / 3.0) + P * (arm * x - 0.5 * x * x)) / b.bending;
  const double bent = (0.5 * q * (L * L * x * x / 2.0 - L * x * x * x / 3.0 + x * x * x * x / 12.0) +
                       P * (0.5 * arm * x * x - x * x * x / 6.0)) /
                      b.bending;
  const double sheared = (q * (L * x - 0.5 * x * x) + P * x) / b.shear;
  return {bent + sheared, rotation};
}

double beam_frequency(const Beam& b, const BeamTip& tip) {
  // Shear, rotary inertia and a tip only lower the frequency of the thin beam, 1.8751^2 sqrt(EI/(rho A L^4)).
  const double thin =
      1.8751040687119611 * 1.8751040687119611 * std::sqrt(b.bending / (b.mass * std::pow(b.length, 4)));
  const int steps = 400;  // down to 1e-5 of it, in steps of 3 %: closer no two roots lie
  double low = 0.0, high = 0.0;
  for (int n = 0; n <= steps && high == 0.0; ++n) {
    const double w = thin * 1.01 * std::pow(1e-5, 1.0 - static_cast<double>(n) / steps);
    if (determinant(b, tip, w) <= 0.0)
      high = w;
    else
      low = w;
  }
  if (high == 0.0)
    throw InputError(
        "the beam has no frequency below that of a thin beam: its length, stiffness or mass is not above 0");
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (determinant(b, tip, middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double rectangular_shear_coefficient(double poisson_ratio, bool plane_strain) {
  const double nu = plane_strain ? poisson_ratio / (1.0 - poisson_ratio) : poisson_ratio;
  return 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
}

Beam rectangular_beam(double length, double height, double depth, double density, double young,
                      double poisson_ratio, bool plane_strain, double kappa) {
  const double area = height * depth, moment = depth * height * height * height / 12.0;
  const double E = plane_strain ? young / (1.0 - poisson_ratio * poisson_ratio) : young,
               G = 0.5 * young / (1.0 + poisson_ratio);
  return {length, E * moment, kappa * G * area, density * area, density * moment};
}

}  // namespace tripoint
