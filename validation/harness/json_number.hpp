// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace tripoint {

/// A number as JSON has it: null where it is not finite, or not there.
[[nodiscard]] inline nlohmann::ordered_json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace tripoint
