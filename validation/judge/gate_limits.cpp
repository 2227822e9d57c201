// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/judge/apply_gate.hpp"

/// A value against the edges of a gate: the verdict, the used part of the allowance, and the edges in
/// words.
namespace tripoint {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

Verdict worse(Verdict a, Verdict b) {
  for (const auto v : {Verdict::fail, Verdict::missing, Verdict::inconclusive})
    if (a == v || b == v) return v;
  return Verdict::pass;
}

bool limits_something(const Gate& gate) { return gate.limit || gate.at_least || gate.band; }

/// Verdict of an interval against [lowest, highest].
Verdict interval_within(const Order& order, double lowest, double highest) {
  if (!(order.low <= order.value && order.value <= order.high) || !std::isfinite(order.low) ||
      !std::isfinite(order.high))
    return Verdict::fail;
  if (order.low >= lowest && order.high <= highest) return Verdict::pass;
  return order.high < lowest || order.low > highest ? Verdict::fail : Verdict::inconclusive;
}

/// Distance from zero in units of the edge on that side: 1 at the edge. An edge at zero leaves no allowance,
/// and what is beyond it counts in the metric's own unit.
double share_of_edge(double value, double edge) {
  if (value == 0.0 || edge * value < 0.0) return 0.0;
  return edge != 0.0 ? value / edge : 1.0 + std::abs(value);
}

/// A band around zero bounds an error, which is best at zero. Any other states a figure, which is best in the
/// middle.
double share_of_band(double value, double low, double high) {
  if (low <= 0.0 && high >= 0.0) return share_of_edge(value, value > 0.0 ? high : low);
  const double half = 0.5 * (high - low), off = std::abs(value - 0.5 * (low + high));
  return half > 0.0 ? off / half : off > 0.0 ? 1.0 + off : 0.0;
}

/// 1 at the least, falls to 0 above it, and rises below it with the same slope.
double share_of_least(double value, double least) {
  if (least <= 0.0) return share_of_edge(std::min(value, 0.0), least);
  return value >= least ? least / value : 2.0 - value / least;
}

}  // namespace

Verdict verdict_of(const Gate& gate, double value, double u) {
  if (!limits_something(gate)) return Verdict::missing;
  auto verdict = Verdict::pass;
  if (gate.limit) verdict = worse(verdict, judge_limit(value, u, *gate.limit));
  if (gate.at_least) verdict = worse(verdict, judge_at_least(value, u, *gate.at_least));
  if (gate.band) verdict = worse(verdict, judge_band(value, u, (*gate.band)[0], (*gate.band)[1]));
  return verdict;
}

Verdict verdict_of(const Gate& gate, const Order& order) {
  if (gate.expect ? order.fit_class != *gate.expect : order.fit_class == FitClass::plateau)
    return Verdict::fail;
  if (!limits_something(gate)) return gate.expect ? Verdict::pass : Verdict::missing;
  auto verdict = Verdict::pass;
  if (gate.limit) verdict = worse(verdict, interval_within(order, -unbounded, *gate.limit));
  if (gate.at_least) verdict = worse(verdict, interval_within(order, *gate.at_least, unbounded));
  if (gate.band) verdict = worse(verdict, interval_within(order, (*gate.band)[0], (*gate.band)[1]));
  return verdict;
}

double share_of_limit(const Gate& gate, double value) {
  if (!std::isfinite(value) || !limits_something(gate)) return not_a_number;
  double used = 0.0;
  if (gate.limit) used = std::max(used, share_of_band(value, -*gate.limit, *gate.limit));
  if (gate.band) used = std::max(used, share_of_band(value, (*gate.band)[0], (*gate.band)[1]));
  if (gate.at_least) used = std::max(used, share_of_least(value, *gate.at_least));
  return used;
}

std::string describe(const Gate& gate) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (gate.limit) add(fmt::format("limit {:g}", *gate.limit));
  if (gate.at_least) add(fmt::format("at least {:g}", *gate.at_least));
  if (gate.band) add(fmt::format("band {:g} to {:g}", (*gate.band)[0], (*gate.band)[1]));
  if (gate.expect) add(fmt::format("class {}", *gate.expect));
  return text.empty() ? "no limit" : text;
}

}  // namespace tripoint
