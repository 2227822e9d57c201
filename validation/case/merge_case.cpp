// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tables/nearest.hpp"
#include "tables/table_reader.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_keys.hpp"
#include "validation/case/gated_metric.hpp"

/// How a case changes the one that it extends: its own values replace those of the base, and values that it
/// removes go.
namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

/// The value of a key as one text; "" where it is not given.
std::string word_at(const TomlNode& item, std::string_view key) {
  const auto* v = item.find(key);
  if (!v) return "";
  if (v->kind == Kind::integer) return show(static_cast<double>(v->integer));
  return v->kind == Kind::text ? v->text : to_toml(*v);
}

/// Keys that tell the tables of an array apart; empty for arrays whose tables have none.
std::vector<std::string_view> identity_keys(std::string_view array) {
  if (array == "material" || array == "body" || array == "metric" || array == "defect" || array == "harmless")
    return {"name"};
  if (array == "gate") return {"metric", "engine", "mode", "preset", "level"};
  if (array == "study") return {"axis", "engine", "mode", "metric"};
  if (array == "input") return {"key"};
  return {};
}

std::string identity(const TomlNode& item, std::string_view array) {
  std::string text;
  for (const auto key : identity_keys(array))
    text +=
        (text.empty() ? "" : ", ") + (item.find(key) ? fmt::format("{} = {}", key, word_at(item, key)) : "");
  return text;
}

void erase(TomlNode& table, std::string_view key) {
  std::erase_if(table.members, [&](const auto& m) { return m.first == key; });
}

/// A bound is one of these: a new one takes the place of the old, of whatever kind that was.
void forget_bounds(TomlNode& base, const TomlNode& own) {
  static constexpr std::array<std::string_view, 5> bounds{"limit", "at_least", "band", "limits", "gates"};
  if (std::none_of(bounds.begin(), bounds.end(), [&](auto key) { return own.find(key) != nullptr; })) return;
  for (const auto key : bounds) erase(base, key);
  if (own.find("gates"))  // of an invariant: they bring whatever else a gate says
    for (const auto& key : case_keys().names("gate")) erase(base, key);
}

void merge_value(TomlNode& base, TomlNode own, const std::string& path);

void merge_table(TomlNode& base, TomlNode own, const std::string& path) {
  if (path == "gate" || path.starts_with("invariants.")) forget_bounds(base, own);
  base.place = own.place;
  base.key_place = own.key_place;
  for (auto& [key, value] : own.members) {
    if (auto* there = base.find(key))
      merge_value(*there, std::move(value), path.empty() ? key : path + "." + key);
    else
      base.members.emplace_back(key, std::move(value));
  }
}

void merge_items(TomlNode& base, TomlNode own, const std::string& array) {
  const std::size_t inherited = base.items.size();
  std::vector<std::string> names, seen;
  for (const auto& item : base.items) names.push_back(identity(item, array));
  for (auto& item : own.items) {
    const auto name = identity(item, array);
    const auto same = std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(inherited), name);
    const bool again = std::find(seen.begin(), seen.end(), name) != seen.end();
    if (same > 1 || (same == 1 && again))
      throw InputError(
          item.place,
          fmt::format("[[{}]] with {}: more than one such table meets, so that none tells which is "
                      "meant: remove those of the extended case (key `remove`), and give all",
                      array, printable(name, 120)));
    seen.push_back(name);
    if (same == 0)
      base.items.push_back(std::move(item));
    else
      merge_table(
          base.items[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())],
          std::move(item), array);
  }
  base.place = own.place;
  base.key_place = own.key_place;
}

/// A table that states its kind anew shares no key with the old one.
bool is_other_kind(const TomlNode& own) { return own.find("kind") || own.find("function"); }

void merge_value(TomlNode& base, TomlNode own, const std::string& path) {
  const bool tables = base.kind == Kind::table && own.kind == Kind::table;
  if (tables && (path == "case" || !is_other_kind(own))) return merge_table(base, std::move(own), path);
  if (base.kind == Kind::array && own.kind == Kind::array && !identity_keys(path).empty())
    return merge_items(base, std::move(own), path);
  base = std::move(own);
}

[[noreturn]] void not_there(const TomlNode& path, const std::string& part) {
  throw InputError(
      path.place,
      fmt::format("`remove`: the extended case has no `{}`: write a key, scene.jitter, a table by its name, "
                  "engines.lammps or metric.overlap (and the gates on it), or all of a kind, study",
                  printable(part)));
}

bool judges(const TomlNode& gate, const std::string& metric) {
  return judges_metric(word_at(gate, "metric"), metric);
}

void remove_gates(TomlNode& document, const std::string& metric) {
  if (auto* gates = document.find("gate"); gates && gates->kind == Kind::array)
    std::erase_if(gates->items, [&](const auto& gate) { return judges(gate, metric); });
}

/// "NAME.key" of a table of the array; false where none has such a name and key.
bool remove_item_key(TomlNode& list, const std::string& path) {
  for (auto& item : list.items) {
    const auto name = word_at(item, "name");
    if (name.empty() || !path.starts_with(name + ".")) continue;
    const auto key = path.substr(name.size() + 1);
    if (!item.find(key)) continue;
    erase(item, key);
    return true;
  }
  return false;
}

void remove_item(TomlNode& document, const std::string& array, const std::string& name,
                 const TomlNode& path) {
  TomlNode& list = *document.find(array);
  const auto before = list.items.size();
  if (array != "gate" && remove_item_key(list, name)) return;
  if (array == "gate") {
    remove_gates(document, name);
  } else {
    const std::string_view key = array == "input" ? "key" : "name";
    std::erase_if(list.items, [&](const auto& item) { return word_at(item, key) == name; });
    if (array == "metric") remove_gates(document, name);
  }
  if (list.items.size() == before) not_there(path, path.text);
}

}  // namespace

void merge_case(TomlNode& base, TomlNode own) {
  forget_forms(base, own);
  merge_table(base, std::move(own), "");
}

void remove_keys(TomlNode& document, const TomlNode& remove) {
  if (remove.kind != Kind::array)
    throw InputError(remove.place,
                     "`remove` is an array of texts: write [\"scene.jitter\", \"engines.lammps\"]");
  for (const auto& path : remove.items) {
    if (path.kind != Kind::text || path.text.empty())
      throw InputError(path.place,
                       "`remove` is an array of texts: write [\"scene.jitter\", \"engines.lammps\"]");
    if (is_old_key(path.text)) {
      remove_form(document, path.text);
      continue;
    }
    TomlNode* at = &document;
    std::string rest = path.text;
    for (auto dot = rest.find('.'); dot != std::string::npos && at->kind == Kind::table;
         dot = rest.find('.')) {
      const std::string part = rest.substr(0, dot);
      TomlNode* next = at->find(part);
      if (!next || (next->kind != Kind::table && at != &document)) not_there(path, path.text);
      rest.erase(0, dot + 1);
      if (next->kind == Kind::array) {
        remove_item(document, part, rest, path);
        rest.clear();
        break;
      }
      at = next;
    }
    if (rest.empty()) continue;
    if (at->kind != Kind::table || !at->find(rest)) not_there(path, path.text);
    erase(*at, rest);
  }
  const auto& all = remove.items;
  const bool no_metric =
      std::any_of(all.begin(), all.end(), [](const auto& path) { return path.text == "metric"; });
  if (no_metric && document.find("gate")) erase(document, "gate");  // each gate is on one of them
}

}  // namespace tripoint
