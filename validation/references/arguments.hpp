// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "core/vec3.hpp"
#include "files/reference_choice.hpp"
#include "scene/term.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {

/// The arguments that a case gives a reference function; omitted ones are taken from the scene.
class Arguments {
 public:
  /// @throws InputError for an argument that the function does not have, with the nearest one that it has,
  /// and for one that is not of its type
  Arguments(const ReferenceChoice&, const ReferenceFunction&);
  /// @throws InputError when the argument is there and is of another kind
  [[nodiscard]] std::optional<double> number(const std::string& name) const;
  [[nodiscard]] std::optional<Vec3> vector(const std::string& name) const;
  [[nodiscard]] std::optional<std::string> word(const std::string& name) const;
  [[nodiscard]] std::optional<bool> flag(const std::string& name) const;
  /// 0, 1, 2 of "x", "y", "z". @throws InputError for any other word
  [[nodiscard]] std::optional<std::size_t> axis(const std::string& name) const;
  /// Which form of an equation the argument `form` names; the fallback where it is not given. @throws
  /// InputError for any word but "paper" and "corrected"
  [[nodiscard]] Mode form(Mode fallback) const;

 private:
  void check(const ReferenceArgument&) const;
  template <class T>
  [[nodiscard]] std::optional<T> get(const std::string& name, const char* kind) const;
  std::string function_;
  Settings args_;
};

}  // namespace tripoint
