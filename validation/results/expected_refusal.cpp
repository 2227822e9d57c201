// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/expected_refusal.hpp"

#include <fmt/format.h>

namespace tripoint {

std::string declared_refusal(const Settings& settings) {
  const auto at = settings.find(refuses_setting);
  const auto* words = at == settings.end() ? nullptr : std::get_if<std::string>(&at->second);
  return words ? *words : "";
}

bool refuses_as_expected(const EngineRow& e) {
  return !e.refuses.empty() && e.status == Status::refused && e.reason.find(e.refuses) != std::string::npos;
}

std::string broken_refusal(const EngineRow& e) {
  if (e.refuses.empty() || e.status == Status::missing || refuses_as_expected(e)) return {};
  if (e.status == Status::refused)
    return fmt::format("refuses for another reason than the declared \"{}\": {}", e.refuses, e.reason);
  return fmt::format(
      "is declared to refuse (\"{}\"), and is {}: take the declaration away, or find what has changed",
      e.refuses, e.status);
}

}  // namespace tripoint
