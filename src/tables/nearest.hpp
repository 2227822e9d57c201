// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tripoint {

/// The known word with the fewest letters to insert, drop, change or swap; empty when none is near (over half
/// its length away).
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& known);

/// " (did you mean `x`?)", or " (known: a, b, c)" when none is near: the tail of a refusal.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// The text as it may be printed in a message: cut at the limit, control bytes replaced.
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 60);

}  // namespace tripoint
