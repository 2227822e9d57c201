// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tripoint {

/// A number as JSON has it: null where it is not finite, or not there.
[[nodiscard]] nlohmann::ordered_json json_number(const std::optional<double>& value);
[[nodiscard]] nlohmann::ordered_json json_numbers(const std::vector<double>& values);

/// A document as text, closed by a line break. Bytes that are no UTF-8 become the replacement character.
/// @param indent blanks a level; -1 = all on one line
[[nodiscard]] std::string json_text(const nlohmann::ordered_json&, int indent = 1);

}  // namespace tripoint
