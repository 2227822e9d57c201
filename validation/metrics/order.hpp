// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/case/case_words.hpp"

namespace tripoint {

/// Observed order of convergence with its 95 % interval and class.
struct Order {
  double value = 0.0, low = 0.0, high = 0.0;  ///< signed; low <= value <= high
  FitClass fit_class = FitClass::too_few;
  double coefficient = 0.0, floor = 0.0;  ///< error = floor + coefficient h^value
};
/// @param step refinement variable, coarse to fine, decreasing (spacing, time step, or 1/levels)
/// @param error error at each step, signed values allowed (their magnitude is fitted)
/// @param uncertainty standard uncertainty of each error, may be empty
/// @param formal formal order, 0 = none
[[nodiscard]] Order fit_order(const std::vector<double>& step, const std::vector<double>& error,
                              const std::vector<double>& uncertainty, double formal);

/// Grid convergence index by least squares [Eca & Hoekstra 2014]: standard uncertainty of the finest value.
[[nodiscard]] double grid_convergence_uncertainty(const std::vector<double>& step,
                                                  const std::vector<double>& value, double formal);
/// The same for every level, coarse to fine. NaN throughout where it cannot be formed (fewer than two levels,
/// no formal order, a value that is not finite).
[[nodiscard]] std::vector<double> grid_convergence_uncertainties(const std::vector<double>& step,
                                                                 const std::vector<double>& value,
                                                                 double formal);

enum class Verdict { pass, fail, inconclusive, missing, diverged };
constexpr WordTable<5> word_table(Verdict) {
  return {"verdict of a gate", {"pass", "fail", "inconclusive", "missing", "diverged"}};
}

/// Against a limit on |value|: pass iff |value| + k u <= limit, fail iff |value| - k u > limit, else
/// inconclusive; a non-finite value fails.
[[nodiscard]] Verdict judge_limit(double value, double u, double limit, double k = 2.0);
/// value >= least, likewise. band: low <= value <= high, likewise.
[[nodiscard]] Verdict judge_at_least(double value, double u, double least, double k = 2.0);
[[nodiscard]] Verdict judge_band(double value, double u, double low, double high, double k = 2.0);

/// Relation of two engines by the margin that the case sets for their difference.
enum class Equivalence { equivalent, different, negligible, unresolved, no_margin };
constexpr WordTable<5> word_table(Equivalence) {
  return {"verdict on two engines",
          {"equivalent", "different", "negligible but real", "unresolved", "no margin is set"}};
}

/// Two engines' difference against a margin; unresolved where one of the three is no number.
[[nodiscard]] Equivalence equivalence(double difference, double u, double margin, double k = 2.0);

}  // namespace tripoint
