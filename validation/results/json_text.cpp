// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/json_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace tripoint {

nlohmann::ordered_json json_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_numbers(const std::vector<double>& values) {
  auto list = nlohmann::ordered_json::array();
  for (const double v : values) list.push_back(json_number(v));
  return list;
}

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tripoint
