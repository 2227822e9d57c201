// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string_view>

#include "core/field.hpp"

namespace tripoint {

struct State;

/// Where a step writes a field, in the order of a step.
enum class Written { drift, density, rates, kick };
[[nodiscard]] constexpr std::string_view to_string(Written w) noexcept {
  constexpr std::string_view words[] = {"drift", "density", "rates", "kick"};
  return words[static_cast<int>(w)];
}

/// A column that is looked at after every step: its values must be finite. The first value that fails is
/// named.
struct Guarded {
  Field<double> field;
  std::string_view name;  ///< in messages
  Written written;
  /// Where values must be above 0 too: unit and the meaning of a lesser one, "K, below absolute zero"
  std::string_view not_positive{};
};

/// A column of whole numbers that stand for rows, or for one of so many kinds: each is `least` or above, and
/// below `end`. A checkpoint that says another is refused (step/checkpoint_bounds.hpp).
struct Bounded {
  Field<int> field;
  long least;
  std::size_t (*end)(const State&);
};

/// Role of a ledger entry for the guard of energy (step/guard.hpp). An entry for which no effect gives a role
/// is energy that the scene turns over.
enum class EntryRole {
  apart,       ///< heat, which dwarfs what moves, or what comes from outside: it is left out
  only_takes,  ///< minus the work of a force that may only take energy: below 0 it is energy from nowhere
  /// Minus the work of a force without stored energy. In a scene laid at rest a value below 0 is energy from
  /// nowhere, unless `only_takes` forces have taken as much
  unbacked
};
struct GuardedEntry {
  std::string_view entry;
  EntryRole role;
  std::string_view made_by{};  ///< in messages: the source of the energy
};

}  // namespace tripoint
