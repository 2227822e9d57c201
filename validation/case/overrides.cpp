// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_keys.hpp"

namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

[[noreturn]] void refuse(const std::string& set, const std::string& what) {
  throw InputError(fmt::format("--set {}: {}", printable(set, 120), what));
}

/// Parts of "a.b.c"; a name with dots in quotes stays whole.
std::vector<std::string> split_path(const std::string& path, const std::string& set) {
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : path) {
    if (c == '"')
      quoted = !quoted;
    else if (c == '.' && !quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  if (parts.size() > 8) refuse(set, "the key has more than 8 parts");
  for (const auto& p : parts)
    if (p.empty()) refuse(set, "a part of the key is empty: write a.b=VALUE");
  return parts;
}

void set_places(TomlNode& node, const SourcePlace& place) {
  node.place = node.key_place = place;
  for (auto& item : node.items) set_places(item, place);
  for (auto& [key, value] : node.members) set_places(value, place);
}

TomlNode parse_value(const std::string& text, const std::string& set) {
  const SourcePlace place{"--set " + printable(set, 120), 0, 0};
  TomlNode value;
  const bool one_line = text.find('\n') == std::string::npos && text.find('\r') == std::string::npos;
  if (!one_line || text.empty()) refuse(set, "write one value on one line after the `=`");
  try {
    TomlNode document = parse_toml("v = " + text, place.file);
    if (document.members.size() != 1) refuse(set, "write one value");
    value = std::move(document.members.front().second);
  } catch (const InputError& e) {
    // The shell eats quotes: a bare word or "3 mm" is a text.
    const bool bare =
        text.find_first_of("\"'[]{}=,#\\") == std::string::npos &&
        std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; });
    if (!bare) refuse(set, fmt::format("the value is no TOML value ({})", e.what()));
    value.kind = Kind::text;
    value.text = text;
  }
  set_places(value, place);
  return value;
}

/// The table of an array that a part of the path names: by its `name`, else by its number from 1.
TomlNode& entry(TomlNode& array, const std::string& part, const std::string& table, const std::string& set) {
  std::vector<std::string> names;
  for (auto& item : array.items) {
    const auto* name = item.find("name");
    if (name && name->kind == Kind::text && name->text == part) return item;
    if (name && name->kind == Kind::text) names.push_back(name->text);
  }
  const bool digits = part.find_first_not_of("0123456789") == std::string::npos && part.size() < 6;
  const auto number = digits ? static_cast<std::size_t>(std::stoul(part)) : 0;
  if (number >= 1 && number <= array.items.size()) return array.items[number - 1];
  // a material of the library that the case takes as it is
  if (table == "material" && !library_file(part).empty()) {
    TomlNode fresh, name;
    name.kind = Kind::text;
    name.text = part;
    fresh.members.emplace_back("name", std::move(name));
    set_places(fresh, {"--set " + printable(set, 120), 0, 0});
    array.items.push_back(std::move(fresh));
    return array.items.back();
  }
  refuse(set,
         fmt::format("no {} is `{}`{}", table, printable(part),
                     names.empty() ? fmt::format(": it has {} entries, counted from 1", array.items.size())
                                   : suggestion(part, names)));
}

/// A word of [model] or an old key that --set gives takes the place of the other.
void forget_other_way(TomlNode& document, const std::vector<std::string>& parts, const TomlNode& value) {
  if (parts.front() != "scene" && parts.front() != "model") return;
  TomlNode own = value;
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    TomlNode around;
    around.members.emplace_back(*part, std::move(own));
    own = std::move(around);
  }
  forget_forms(document, own);
}

}  // namespace

void apply_override(TomlNode& document, const std::string& set) {
  const auto equals = set.find('=');
  if (equals == std::string::npos || equals == 0)
    refuse(set, "write a.b=VALUE, for example scene.spacing=0.01");
  std::string path = set.substr(0, equals);
  while (!path.empty() && path.back() == ' ') path.pop_back();
  auto text = set.substr(equals + 1);
  text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
  const auto parts = split_path(path, set);
  TomlNode value = parse_value(text, set);
  forget_other_way(document, parts, value);
  TomlNode* at = &document;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    auto* next = at->find(parts[i]);
    if (!next) {
      TomlNode fresh;
      const auto rows = at == &document ? case_keys().of("") : std::vector<const Key*>{};
      if (std::any_of(rows.begin(), rows.end(),
                      [&](const Key* k) { return k->name == parts[i] && k->type == ValueType::tables; }))
        fresh.kind = Kind::array;
      set_places(fresh, value.place);
      at->members.emplace_back(parts[i], std::move(fresh));
      next = &at->members.back().second;
    }
    if (next->kind == Kind::array) {
      next = &entry(*next, parts[i + 1], parts[i], set);
      ++i;
      if (i + 1 >= parts.size()) return static_cast<void>(*next = std::move(value));
    }
    if (next->kind != Kind::table)
      refuse(set, fmt::format("`{}` is {} and has no keys: give the whole value", printable(parts[i]),
                              kind_name(next->kind)));
    at = next;
  }
  if (auto* there = at->find(parts.back()))
    *there = std::move(value);
  else
    at->members.emplace_back(parts.back(), std::move(value));
}

}  // namespace tripoint
