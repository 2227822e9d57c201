// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <Eigen/Dense>
#include <limits>

#include "validation/metrics/order.hpp"

namespace tripoint {
namespace {

using List = std::vector<double>;

/// value = limit + terms of h by linear least squares.
struct Expansion {
  double limit = 0.0, deviation = 0.0;  ///< standard deviation of the fit
  List residual;                        ///< value - fit at each level
};

Expansion expand(const List& h, const List& value, const List& powers) {
  const auto n = static_cast<Eigen::Index>(h.size()), m = static_cast<Eigen::Index>(powers.size()) + 1;
  Eigen::MatrixXd A(n, m);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, 0) = 1.0;
    for (Eigen::Index j = 1; j < m; ++j) A(i, j) = std::pow(h[i] / h[0], powers[j - 1]);
    b(i) = value[i];
  }
  const Eigen::VectorXd x = A.colPivHouseholderQr().solve(b), r = b - A * x;
  const double dof = static_cast<double>(n - m);
  return {x[0], dof > 0.0 ? std::sqrt(r.squaredNorm() / dof) : 0.0, List(r.data(), r.data() + n)};
}

double observed_order(const List& h, const List& value) {
  const auto misfit = [&](double p) {
    const auto fit = expand(h, value, {p});
    return fit.deviation * fit.deviation;
  };
  if (h.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double best = 0.1;
  // Three levels: no residual of freedom is left, so minimise the sum itself
  const auto exact = [&](double p) {
    const auto fit = expand(h, value, {p});
    return h.size() > 3 ? fit.deviation : std::abs(fit.residual.back());
  };
  for (double p = 0.1; p <= 8.0; p += 0.05)
    if (exact(p) < exact(best)) best = p;
  return boost::math::tools::brent_find_minima([&](double p) { return h.size() > 3 ? misfit(p) : exact(p); },
                                               std::max(best - 0.05, 0.02), best + 0.05, 40)
      .first;
}

}  // namespace

List grid_convergence_uncertainties(const List& step, const List& value, double formal) {
  const std::size_t n = step.size();
  const List unknown(n, std::numeric_limits<double>::quiet_NaN());
  if (n != value.size() || n < 2 || !(formal > 0.0)) return unknown;
  if (!std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); })) return unknown;
  const auto [least, greatest] = std::minmax_element(value.begin(), value.end());
  if (*least == *greatest) return List(n, 0.0);
  if (n == 2) {  // Roache's factor 3 for two grids
    const double ratio = std::pow(step[0] / step[1], formal),
                 fine = 0.5 * 3.0 * std::abs(value[1] - value[0]) / (ratio - 1.0);
    return {ratio * fine, fine};
  }
  const double p = observed_order(step, value);
  const bool good = p >= 0.5 && p < 1.05 * formal;
  Expansion fit = expand(step, value, {p});
  if (!good) {  // fixed powers; the one with the least deviation
    const std::vector<List> models =
        n > 3 ? std::vector<List>{{1.0}, {2.0}, {1.0, 2.0}} : std::vector<List>{{1.0}, {2.0}};
    fit = expand(step, value, models.front());
    for (const auto& powers : models)
      if (auto other = expand(step, value, powers); other.deviation < fit.deviation) fit = std::move(other);
  }
  const double range = (*greatest - *least) / static_cast<double>(n - 1);
  const double factor = good && fit.deviation < range ? 1.25 : 3.0;
  List u;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = std::abs(value[i] - fit.residual[i] - fit.limit);
    double U95 = factor * error + fit.deviation + std::abs(fit.residual[i]);
    if (fit.deviation >= range) U95 *= fit.deviation / range;
    u.push_back(0.5 * U95);
  }
  return u;
}

double grid_convergence_uncertainty(const List& step, const List& value, double formal) {
  const auto all = grid_convergence_uncertainties(step, value, formal);
  return all.empty() ? std::numeric_limits<double>::quiet_NaN() : all.back();
}

}  // namespace tripoint
