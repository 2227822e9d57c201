// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "tables/nearest.hpp"

/// Enumerations that files and messages know by words: one table an enumeration, and both directions made
/// from it.
namespace tripoint {

/// The words of an enumeration, in the order of its values.
template <std::size_t n>
struct WordTable {
  const char* what;  ///< what one of them is called in a refusal: "status of a run"
  std::array<const char*, n> words;
};

/// An enumeration has words where `constexpr WordTable<n> word_table(E)` stands beside it.
template <class E>
concept HasWords = std::is_enum_v<E> && requires(E e) {
  word_table(e).words.size();
};

template <HasWords E>
[[nodiscard]] constexpr std::string_view to_string(E e) {
  return word_table(e).words.at(static_cast<std::size_t>(e));
}

template <HasWords E>
std::ostream& operator<<(std::ostream& out, E e) {
  return out << to_string(e);
}

/// Every value, in order.
template <HasWords E>
[[nodiscard]] constexpr auto all_of() {
  std::array<E, word_table(E{}).words.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<E>(i);
  return values;
}

/// The value that the word names; empty where it names none.
template <HasWords E>
[[nodiscard]] std::optional<E> find_word(std::string_view word) {
  for (const E e : all_of<E>())
    if (to_string(e) == word) return e;
  return {};
}

/// Inverse of to_string. @throws InputError naming the word, and the nearest that is known or all of them
template <HasWords E>
[[nodiscard]] E from_word(std::string_view word) {
  if (const auto found = find_word<E>(word)) return *found;
  constexpr auto table = word_table(E{});
  throw InputError("`" + printable(word) + "` is no " + table.what +
                   suggestion(word, {table.words.begin(), table.words.end()}));
}

/// The words in one line, separated by blanks, as a row of the key table has them.
template <HasWords E>
inline constexpr auto joined_words = [] {
  std::array<char,
             [] {
               std::size_t size = word_table(E{}).words.size() - 1;
               for (const char* word : word_table(E{}).words) size += std::string_view(word).size();
               return size;
             }()>
      line{};
  line.fill(' ');
  std::size_t at = 0;
  for (const char* word : word_table(E{}).words) {
    std::copy_n(word, std::string_view(word).size(), line.begin() + static_cast<std::ptrdiff_t>(at));
    at += std::string_view(word).size() + 1;
  }
  return line;
}();
template <HasWords E>
inline constexpr std::string_view word_line{joined_words<E>.data(), joined_words<E>.size()};

}  // namespace tripoint

/// Printed as its word.
template <tripoint::HasWords E>
struct fmt::formatter<E> : fmt::formatter<std::string_view> {
  auto format(E e, fmt::format_context& context) const {
    return fmt::formatter<std::string_view>::format(tripoint::to_string(e), context);
  }
};

/// In JSON its word. It is read by from_word alone, where the file and the key are known.
template <tripoint::HasWords E>
struct nlohmann::adl_serializer<E, void> {
  template <class Json>
  static void to_json(Json& json, E e) {
    json = std::string(tripoint::to_string(e));
  }
};
