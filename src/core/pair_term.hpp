// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string_view>

#include "core/field.hpp"

/// Pair terms by their types, for code that chooses among compiled passes at run time.
namespace tripoint {

struct PairTerm {
  std::string_view name;
  std::uint64_t key = key_of(name);
  constexpr bool operator==(const PairTerm& other) const noexcept { return key == other.key; }
};

namespace detail {

template <class T>
[[nodiscard]] consteval std::string_view name_of_type() {
  const std::string_view whole = __PRETTY_FUNCTION__;  // "... [with T = tripoint::HeatMoment; ...", clang: "[T = ...]"
  const std::size_t from = whole.find("T = ") + 4;
  return whole.substr(from, whole.find_first_of(";]", from) - from);
}

}  // namespace detail

/// The key of the term T, a struct with `reads`, `adds` and `pair` (sph/pass.hpp).
template <class T>
inline constexpr PairTerm pair_term{detail::name_of_type<T>()};

}  // namespace tripoint
