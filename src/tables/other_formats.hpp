// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

namespace tripoint {

/// Of a text that is no TOML: the name of the program's format that it is in; empty where none is known.
[[nodiscard]] std::string other_format(std::string_view text);

}  // namespace tripoint
