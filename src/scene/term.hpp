// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/field.hpp"

/// Terms of the model that have a printed and a corrected form are typed keys, as fields and energy accounts
/// are. The effect that a term is of declares it in its rule (effect_rule.hpp).
namespace tripoint {

enum class Mode { corrected, paper };

/// `model.NAME` of a case file, and `modes.NAME` of old ones.
struct Term {
  std::string_view name;  ///< of text that lasts as long as the program
  std::uint64_t key = key_of(name);
  constexpr bool operator==(const Term& other) const noexcept { return key == other.key; }
  constexpr bool operator<(const Term& other) const noexcept { return key < other.key; }
};

/// The forms of terms.
using TermModes = std::map<Term, Mode>;
using TermForms = std::map<Term, std::string>;

/// A term was asked for that no effect has declared: a fault of the program, so it says the term by name.
class UndeclaredTerm : public std::logic_error {
 public:
  explicit UndeclaredTerm(std::string_view name)
      : std::logic_error("no effect has declared the term " + std::string(name)) {}
};

}  // namespace tripoint
