// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/json_number.hpp"

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

}  // namespace tripoint
