// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

namespace tripoint {

/// Levels that JSON of others may nest: ours has ten, and a reader that calls itself once a level runs out of stack at some
/// 100,000.
inline constexpr int most_levels = 64;

/// Whether brackets and braces outside of strings nest deeper than most_levels. Looked at before a text of others is parsed.
[[nodiscard]] inline bool nests_too_deep(std::string_view json) noexcept {
  int level = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_string && c == '\\')
      ++k;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '{' || c == '[') && ++level > most_levels)
      return true;
    else if (!in_string && (c == '}' || c == ']'))
      --level;
  }
  return false;
}

}  // namespace tripoint
