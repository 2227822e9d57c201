// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "core/field.hpp"

namespace tripoint {

/// Where a step writes a field, in the order of a step.
enum class Written { drift, density, rates, kick };
[[nodiscard]] constexpr std::string_view to_string(Written w) noexcept {
  constexpr std::string_view words[] = {"drift", "density", "rates", "kick"};
  return words[static_cast<int>(w)];
}

/// A column that is looked at after every step: its values must be finite. What goes wrong first is named.
struct Guarded {
  Field<double> field;
  std::string_view name;  ///< in messages
  Written written;
  std::string_view
      not_positive{};  ///< where values must be above 0 too: unit and what a lesser one would be, "K, below absolute zero"
};

}  // namespace tripoint
