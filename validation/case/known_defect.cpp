// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/known_defect.hpp"
#include "validation/case/choices.hpp"

#include <string_view>

namespace tripoint {

std::string known_defect(const Gate& gate) {
  static constexpr std::string_view head = "known defect ";
  const auto end = gate.reason.find_first_of(" :", head.size());
  if (!gate.reason.starts_with(head) || end == std::string::npos || gate.reason[end] != ':') return {};
  return gate.reason.substr(head.size(), end - head.size());
}

std::string declared_defect(const Gate& gate) {
  return gate.reason.starts_with("predicted defect") ? "printed-form" : known_defect(gate);
}

}  // namespace tripoint
