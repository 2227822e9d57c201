// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/power_law.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

namespace tripoint {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Estimate with_interval(double value, double standard_error, int degrees_of_freedom) {
  const double t = student_95(degrees_of_freedom);
  if (!std::isfinite(t)) return {value, -infinity, infinity};
  return {value, value - t * standard_error, value + t * standard_error};
}

/// Least squares of (floor + C h^p - e)/|e| over floor and C.
struct LinearPart {
  double floor, coefficient, residual;
};
LinearPart solve_for(double p, const std::vector<double>& h, const std::vector<double>& e) {
  const auto n = static_cast<Eigen::Index>(h.size());
  Eigen::MatrixXd A(n, 2);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double weight = 1.0 / std::abs(e[i]);
    A(i, 0) = weight;
    A(i, 1) = weight * std::pow(h[i] / h[0], p);
    b(i) = weight * e[i];
  }
  const Eigen::Vector2d x = A.colPivHouseholderQr().solve(b);
  return {x[0], x[1] / std::pow(h[0], p), (A * x - b).squaredNorm()};
}

/// Standard errors of floor and p from the Jacobian of the relative residuals at the solution.
std::pair<double, double> standard_errors(const LinearPart& fit, double p, const std::vector<double>& h,
                                          const std::vector<double>& e) {
  const auto n = static_cast<Eigen::Index>(h.size());
  Eigen::MatrixXd J(n, 3);
  const double scale = fit.coefficient * std::pow(h[0], p);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double power = std::pow(h[i] / h[0], p), weight = 1.0 / std::abs(e[i]);
    J.row(i) << weight, weight * power, weight * scale * power * std::log(h[i] / h[0]);
  }
  const Eigen::Vector3d size = J.colwise().norm().cwiseMax(1e-300);
  const Eigen::Matrix3d normal =
      (J * size.cwiseInverse().asDiagonal()).transpose() * (J * size.cwiseInverse().asDiagonal());
  const Eigen::Matrix3d covariance =
      normal.completeOrthogonalDecomposition().pseudoInverse() * (fit.residual / static_cast<double>(n - 3));
  return {std::sqrt(std::max(covariance(0, 0), 0.0)) / size[0],
          std::sqrt(std::max(covariance(2, 2), 0.0)) / size[2]};
}

}  // namespace

double student_95(int degrees_of_freedom) {
  if (degrees_of_freedom < 1) return infinity;
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

double akaike(double residual, std::size_t n, std::size_t parameters) {
  const double count = static_cast<double>(n), k = static_cast<double>(parameters);
  const double correction = count - k - 1.0 > 0.0 ? 2.0 * k * (k + 1.0) / (count - k - 1.0) : 0.0;
  // 1e-26: round-off of double
  return count * std::log(std::max(residual, 1e-26) / count) + 2.0 * k + correction;
}

PowerLaw fit_power_law(const std::vector<double>& h, const std::vector<double>& e) {
  const double n = static_cast<double>(h.size());
  double x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    x_mean += std::log(h[i]) / n;
    y_mean += std::log(std::abs(e[i])) / n;
  }
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double x = std::log(h[i]) - x_mean;
    xx += x * x;
    xy += x * (std::log(std::abs(e[i])) - y_mean);
  }
  PowerLaw fit;
  const double p = xy / xx;
  fit.coefficient = std::exp(y_mean - p * x_mean);
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double r = std::log(std::abs(e[i])) - y_mean - p * (std::log(h[i]) - x_mean);
    fit.residual += r * r;
  }
  const int dof = static_cast<int>(h.size()) - 2;
  fit.order = with_interval(p, dof > 0 ? std::sqrt(fit.residual / dof / xx) : infinity, dof);
  return fit;
}

FlooredPowerLaw fit_floored_power_law(const std::vector<double>& h, const std::vector<double>& e) {
  FlooredPowerLaw fit;
  if (h.size() < 4) return fit;
  const auto residual = [&](double p) { return solve_for(p, h, e).residual; };
  constexpr double first = 0.2, last = 8.0, step = 0.05;
  double best = first;
  for (double p = first; p <= last; p += step)
    if (residual(p) < residual(best)) best = p;
  if (best < first + 0.5 * step || best > last - 1.5 * step) return fit;
  const double p = boost::math::tools::brent_find_minima(residual, best - step, best + step, 50).first;
  const auto linear = solve_for(p, h, e);
  const auto [floor_error, order_error] = standard_errors(linear, p, h, e);
  const int dof = static_cast<int>(h.size()) - 3;
  fit.order = with_interval(p, order_error, dof);
  fit.floor = with_interval(linear.floor, floor_error, dof);
  fit.coefficient = linear.coefficient;
  fit.residual = linear.residual;
  fit.found = true;
  return fit;
}

}  // namespace tripoint
