// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "validation/metrics/order.hpp"

namespace tripoint {
namespace {

/// A value or bound that is not a number never passes; an uncertainty that is not one cannot be judged with.
bool judged(double value, double bound) { return std::isfinite(value) && !std::isnan(bound); }
bool usable(double u) { return u >= 0.0 && std::isfinite(u); }

}  // namespace

Verdict judge_limit(double value, double u, double limit, double k) {
  if (!judged(value, limit)) return Verdict::fail;
  if (!usable(u)) return Verdict::inconclusive;
  if (std::abs(value) + k * u <= limit) return Verdict::pass;
  return std::abs(value) - k * u > limit ? Verdict::fail : Verdict::inconclusive;
}

Verdict judge_at_least(double value, double u, double least, double k) {
  if (!judged(value, least)) return Verdict::fail;
  if (!usable(u)) return Verdict::inconclusive;
  if (value - k * u >= least) return Verdict::pass;
  return value + k * u < least ? Verdict::fail : Verdict::inconclusive;
}

Verdict judge_band(double value, double u, double low, double high, double k) {
  if (!judged(value, low) || std::isnan(high)) return Verdict::fail;
  if (!usable(u)) return Verdict::inconclusive;
  if (value - k * u >= low && value + k * u <= high) return Verdict::pass;
  return value + k * u < low || value - k * u > high ? Verdict::fail : Verdict::inconclusive;
}

Equivalence equivalence(double difference, double u, double margin, double k) {
  if (!std::isfinite(difference) || !usable(u) || !(margin > 0.0)) return Equivalence::unresolved;
  const double low = difference - k * u, high = difference + k * u;
  if (low > margin || high < -margin) return Equivalence::different;
  if (low < -margin || high > margin) return Equivalence::unresolved;
  return std::abs(difference) > k * u ? Equivalence::negligible : Equivalence::equivalent;
}

}  // namespace tripoint
