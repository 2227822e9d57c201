// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "core/errors.hpp"
#include "scene/guard_name.hpp"
#include "state/state.hpp"

/// How guards name what went wrong.
namespace tripoint {

/// "particle 7 of body "beam" is ...": who it is in the whole scene, and at which time.
[[nodiscard]] Diverged failure_of(const State&, GuardName guard, std::size_t row, std::string_view field,
                                  std::string_view stage, const std::string& what);

/// @throws Diverged, always
[[noreturn]] void fail(const State&, GuardName guard, std::size_t row, std::string_view field,
                       std::string_view stage, const std::string& what);

/// Whether the scene has switched this guard off.
[[nodiscard]] bool is_off(const Scene&, GuardName);

}  // namespace tripoint
