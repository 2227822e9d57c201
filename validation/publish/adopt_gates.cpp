// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/publish/adopt.hpp"

/// Gates from measured values.
namespace tripoint {
namespace {

constexpr double least_limit = 1e-10;       // a limit of round-off, of which no headroom is asked
constexpr double round_off_headroom = 3.0;  // another machine rounds otherwise
constexpr double noise_headroom = 4.0;      // standard deviations over repeats and seeds
constexpr double order_headroom = 0.2;      // beyond the interval of a fitted order

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread s;
  const double n = static_cast<double>(values.size());
  for (const double v : values) s.mean += v / n;
  for (const double v : values) s.deviation += (v - s.mean) * (v - s.mean);
  s.deviation = n > 1.0 ? std::sqrt(s.deviation / (n - 1.0)) : 0.0;
  return s;
}

double noise_of(const Measured& m) {
  return noise_headroom * spread_of(m.values).deviation + 2.0 * m.uncertainty;
}

}  // namespace

std::string noise_exceeds_value(const std::string& metric, const Measured& m, double round_off) {
  const double size = std::abs(spread_of(m.values).mean), noise = noise_of(m);
  if (noise <= std::max({size, round_off, least_limit})) return {};
  return fmt::format(
      "the noise of {} exceeds its value: four standard deviations of {} runs and seeds, and twice the "
      "stated "
      "uncertainty, are {:.3g}, and the value is {:.3g}",
      metric, m.values.size(), noise, size);
}

Gate adopted_gate(const std::string& metric, const Measured& m, double margin, double round_off) {
  Gate gate;
  gate.metric = metric;
  const auto s = spread_of(m.values);
  const double noise = noise_of(m), size = std::abs(s.mean);
  const double apart = m.values.size() > 1 ? std::abs(m.values[1] - m.values[0]) : 0.0;
  const std::string measured = fmt::format(
      "adopted: {:.4g} measured, {:.2g} apart in a repeat{}", m.values.front(), apart,
      m.values.size() > 2
          ? fmt::format(", standard deviation {:.2g} over {} runs and seeds", s.deviation, m.values.size())
          : "");
  if (size <= round_off) {
    gate.limit = std::max({least_limit, round_off_headroom * size, size + noise});
    gate.reason = measured + "; an error of round-off may be anything smaller";
    return gate;
  }
  const double low = size / margin - noise, high = size * margin + noise;
  gate.band = s.mean > 0.0 ? std::array{low, high} : std::array{-high, -low};
  gate.reason = fmt::format("{}; headroom by a factor of {:g} to either side{}", measured, margin,
                            noise > 0.0 ? fmt::format(", and {:.2g} for the noise", noise) : "");
  return gate;
}

Gate adopted_order_gate(const OrderRow& order) {
  Gate gate;
  const auto& o = order.order;
  gate.metric = order.metric + ".order";
  gate.band = std::array{o.low - order_headroom, o.high + order_headroom};
  gate.reason = fmt::format(
      "adopted: observed order {:.3g}, 95 % interval {:.3g} to {:.3g}; headroom of {:g} beyond it", o.value,
      o.low, o.high, order_headroom);
  return gate;
}

}  // namespace tripoint
