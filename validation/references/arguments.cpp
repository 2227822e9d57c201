// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/arguments.hpp"

#include <algorithm>

#include "scene/scene.hpp"
#include "tables/nearest.hpp"

namespace tripoint {

Arguments::Arguments(const ReferenceChoice& choice, const ReferenceFunction& function)
    : function_(function.name), args_(choice.args) {
  std::vector<std::string> known;
  for (const auto& a : function.args) known.push_back(a.name);
  for (const auto& a : function.args)
    if (args_.contains(a.name)) check(a);
  for (const auto& [name, value] : args_) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError("reference function " + function_ + " has no argument `" + printable(name) + "`" +
                     suggestion(name, known));
  }
}

void Arguments::check(const ReferenceArgument& a) const {
  switch (a.type) {
    case ArgumentType::number:
      static_cast<void>(number(a.name));
      break;
    case ArgumentType::vector:
      static_cast<void>(vector(a.name));
      break;
    case ArgumentType::flag:
      static_cast<void>(flag(a.name));
      break;
    case ArgumentType::axis:
      static_cast<void>(axis(a.name));
      break;
    case ArgumentType::word:
    case ArgumentType::formula:
      static_cast<void>(word(a.name));
  }
}

template <class T>
std::optional<T> Arguments::get(const std::string& name, const char* kind) const {
  const auto found = args_.find(name);
  if (found == args_.end()) return {};
  if (const auto* value = std::get_if<T>(&found->second)) return *value;
  throw InputError("argument `" + name + "` of reference function " + function_ + " must be " + kind);
}

std::optional<double> Arguments::number(const std::string& name) const {
  return get<double>(name, "a number");
}
std::optional<std::string> Arguments::word(const std::string& name) const {
  return get<std::string>(name, "a text");
}
std::optional<bool> Arguments::flag(const std::string& name) const {
  return get<bool>(name, "true or false");
}

std::optional<std::size_t> Arguments::axis(const std::string& name) const {
  const auto letter = word(name);
  if (!letter) return {};
  if (letter->size() == 1 && *letter >= "x" && *letter <= "z")
    return static_cast<std::size_t>((*letter)[0] - 'x');
  throw InputError("argument `" + name + "` of reference function " + function_ +
                   " must be \"x\", \"y\" or \"z\"");
}

Mode Arguments::form(Mode fallback) const {
  const auto given = word("form");
  if (!given) return fallback;
  for (const Mode mode : {Mode::paper, Mode::corrected})
    if (*given == to_string(mode)) return mode;
  throw InputError("argument `form` of reference function " + function_ +
                   " must be \"paper\" or \"corrected\"");
}

std::optional<Vec3> Arguments::vector(const std::string& name) const {
  const auto list = get<std::vector<double>>(name, "three numbers");
  if (!list) return {};
  if (list->size() != 3)
    throw InputError("argument `" + name + "` of reference function " + function_ + " must be three numbers");
  return Vec3{(*list)[0], (*list)[1], (*list)[2]};
}

}  // namespace tripoint
