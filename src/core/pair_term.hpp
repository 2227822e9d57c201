// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/field.hpp"

/// Names of pair terms, for code that chooses among compiled passes at run time.
namespace tripoint {

struct PairTerm {
  std::string_view name;
  std::uint64_t key = key_of(name);
  constexpr bool operator==(const PairTerm& other) const noexcept { return key == other.key; }
};

/// The term T, a struct with `name`, `reads`, `adds` and `pair` (pairs/pass.hpp). No other term has its name.
template <class T>
inline constexpr PairTerm pair_term{T::name};

/// The name of one of several terms that a template makes: its parts one after the other.
template <const std::string_view&... parts>
struct JoinedName {
  static constexpr auto text = [] {
    std::array<char, (parts.size() + ...)> all{};
    auto end = all.begin();
    ((end = std::ranges::copy(parts, end).out), ...);
    return all;
  }();
  static constexpr std::string_view value{text.data(), text.size()};
};

}  // namespace tripoint
