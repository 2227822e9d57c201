// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <string_view>

/// What a gate judges of a metric: its value, or what is fitted to the metric over the levels of a study.
namespace tripoint {

inline constexpr std::string_view order_part = ".order";  ///< the observed order of convergence
/// The error extrapolated to step or spacing 0
inline constexpr std::string_view limit_part = ".limit";
/// The statistical standard uncertainty
inline constexpr std::string_view statistical_part = ".statistical";

/// NAME of NAME, NAME.order, NAME.limit and NAME.statistical.
[[nodiscard]] inline std::string metric_of_gate(std::string_view gated) {
  for (const auto part : std::array{order_part, limit_part, statistical_part})
    if (gated.ends_with(part)) return std::string(gated.substr(0, gated.size() - part.size()));
  return std::string(gated);
}

/// Whether a gate judges a part of this metric.
[[nodiscard]] inline bool judges_metric(std::string_view gated, std::string_view metric) {
  return gated == metric || metric_of_gate(gated) == metric;
}

[[nodiscard]] constexpr bool is_order(std::string_view gated) { return gated.ends_with(order_part); }
[[nodiscard]] constexpr bool is_limit_of_ladder(std::string_view gated) {
  return gated.ends_with(limit_part);
}
/// Whether it is fitted to the levels of a study.
[[nodiscard]] constexpr bool is_of_ladder(std::string_view gated) {
  return is_order(gated) || is_limit_of_ladder(gated);
}

/// NAME of NAME.order and NAME.limit, which may be NAME.statistical; else the text itself.
[[nodiscard]] constexpr std::string_view fitted_metric(std::string_view gated) {
  return is_order(gated)
             ? gated.substr(0, gated.size() - order_part.size())
             : gated.substr(0, gated.size() - (is_limit_of_ladder(gated) ? limit_part.size() : 0));
}

}  // namespace tripoint
