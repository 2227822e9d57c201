// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tables/words.hpp"

namespace tripoint {

/// What a guard of the run looks for. A scene can switch off those before `finite`.
enum class GuardName {
  inversion,   ///< det F <= 0
  overlap,     ///< a solid or liquid that is pressed to more than two coinciding layers
  escape,      ///< a particle that has left the domain
  ledger,      ///< energy that the scheme has made or lost
  time_step,   ///< a time step that has collapsed
  finite,      ///< a value that is not finite
  temperature  ///< a temperature at or below 0 K
};
constexpr WordTable<7> word_table(GuardName) {
  return {"guard", {"inversion", "overlap", "escape", "ledger", "time_step", "finite", "temperature"}};
}

/// The words of those that a scene can switch off, as a row of the key table has them.
inline constexpr std::string_view words_of_optional_guards =
    word_line<GuardName>.substr(0, word_line<GuardName>.find(to_string(GuardName::finite)) - 1);

}  // namespace tripoint
