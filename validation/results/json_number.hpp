// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace tripoint {

/// A number as JSON has it: null where it is not finite, or not there.
[[nodiscard]] nlohmann::ordered_json json_number(const std::optional<double>& value);
[[nodiscard]] nlohmann::ordered_json json_numbers(const std::vector<double>& values);

}  // namespace tripoint
