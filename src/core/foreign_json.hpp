// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace tripoint {

/// Levels that JSON of others may nest. Our own has ten. A reader that calls itself once a level runs out of
/// stack at some 100,000.
inline constexpr std::size_t most_levels = 64;
/// Keys that one object of others may have: a reader that keeps their order looks through all of them for
/// each.
inline constexpr int most_keys = 10'000;

/// Why a text of others is not parsed as JSON; "" where it may be. Reasons: "nests deeper than 64 levels",
/// "has an object of more than 10000 keys". One pass over the text; all other content is left to the parser.
[[nodiscard]] inline std::string unfit_json(std::string_view json) {
  std::array<int, most_levels + 1> keys{};  // of the open object of each level
  std::size_t level = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_string) {
      if (c == '\\')
        ++k;
      else if (c == '"')
        in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++level > most_levels) return "nests deeper than " + std::to_string(most_levels) + " levels";
      keys[level] = 0;
    } else if (c == '}' || c == ']') {
      level -= level > 0 ? 1 : 0;
    } else if (c == ':') {
      if (++keys[level] > most_keys)
        return "has an object of more than " + std::to_string(most_keys) + " keys";
    }
  }
  return {};
}

}  // namespace tripoint
