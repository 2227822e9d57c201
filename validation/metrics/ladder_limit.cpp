// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/ladder_limit.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "validation/metrics/power_law.hpp"

namespace tripoint {
namespace {

using List = std::vector<double>;

struct Fit {
  double limit = 0.0, standard_error = 0.0;
  /// Of the weighted residuals, a degree of freedom
  double deviation = std::numeric_limits<double>::infinity();
  Eigen::VectorXd shares;  ///< weight of each error in the limit
};

/// Weighted least squares of limit + sum of a_p h^p. The truncated terms grow with h, and so does the
/// distrust of a level.
Fit fit_model(const List& h, const Eigen::VectorXd& error, const List& powers) {
  const auto n = static_cast<Eigen::Index>(h.size()), m = static_cast<Eigen::Index>(powers.size()) + 1;
  Eigen::MatrixXd A(n, m);
  Eigen::VectorXd weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    weight[i] = h[n - 1] / h[i];
    A(i, 0) = weight[i];
    for (Eigen::Index j = 1; j < m; ++j) A(i, j) = weight[i] * std::pow(h[i] / h[0], powers[j - 1]);
  }
  const Eigen::MatrixXd inverse = A.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::VectorXd b = weight.cwiseProduct(error), x = inverse * b, r = A * x - b;
  Fit fit;
  fit.limit = x[0];
  fit.deviation = std::sqrt(r.squaredNorm() / static_cast<double>(n - m));
  fit.standard_error = 0.5 * student_95(static_cast<int>(n - m)) * fit.deviation * inverse.row(0).norm();
  fit.shares = inverse.row(0).transpose().cwiseProduct(weight);
  return fit;
}

Fit best_model(const List& h, const Eigen::VectorXd& error) {
  Fit best;
  for (const List& powers : {List{1.0}, List{2.0}, List{4.0}, List{1.0, 2.0}}) {
    if (h.size() < powers.size() + 2) continue;
    if (auto fit = fit_model(h, error, powers); fit.deviation < best.deviation) best = std::move(fit);
  }
  return best;
}

bool is_monotone(const Eigen::VectorXd& e) {
  bool falls = true, rises = true;
  for (Eigen::Index i = 1; i < e.size(); ++i) {
    falls = falls && std::abs(e[i]) <= std::abs(e[i - 1]);
    rises = rises && std::abs(e[i]) >= std::abs(e[i - 1]);
  }
  return falls || rises;
}

/// Of magnitudes that fall and rise again: the errors from some level on have the other sign.
Fit best_sign(const List& h, Eigen::VectorXd error) {
  auto best = best_model(h, error);
  if (is_monotone(error)) return best;
  for (Eigen::Index from = error.size() - 1; from > 0; --from) {
    error[from] = -error[from];
    if (auto fit = best_model(h, error); fit.deviation < best.deviation) best = std::move(fit);
  }
  return best;
}

}  // namespace

LadderLimit ladder_limit(const List& step, const List& error, const List& uncertainty) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (step.size() < 3 || step.size() != error.size() || !std::all_of(error.begin(), error.end(), finite))
    return {};
  const auto fit = best_sign(
      step, Eigen::Map<const Eigen::VectorXd>(error.data(), static_cast<Eigen::Index>(error.size())));
  double variance = fit.standard_error * fit.standard_error;
  for (std::size_t i = 0; i < uncertainty.size(); ++i)
    variance += std::pow(fit.shares[static_cast<Eigen::Index>(i)] * uncertainty[i], 2);
  return {fit.limit, std::sqrt(variance)};
}

}  // namespace tripoint
