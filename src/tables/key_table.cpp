// SPDX-License-Identifier: BSD-3-Clause
#include "tables/key_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace tripoint {
namespace {

using enum Range;

constexpr std::array type_texts{"number",
                                "integer",
                                "true or false",
                                "text",
                                "word",
                                "[x, y, z]",
                                "array of numbers",
                                "array of texts",
                                "number or \"auto\"",
                                "text or array of texts",
                                "array of words",
                                "table",
                                "array of tables",
                                "table of free keys",
                                "shape",
                                "number or table",
                                "[x, y, z] or table",
                                "limit, or table"};
constexpr std::array range_texts{"",
                                 "greater than 0",
                                 "0 or greater",
                                 "from 0 to 1",
                                 "greater than -1 and less than 0.5",
                                 "greater than 1"};

}  // namespace

std::vector<const Key*> KeyTable::of(std::string_view table) const {
  std::vector<const Key*> rows;
  for (const auto& k : rows_)
    if (k.table == table) rows.push_back(&k);
  return rows;
}

std::vector<std::string> KeyTable::names(std::string_view table) const {
  std::vector<std::string> names;
  for (const auto* k : of(table))
    if (!k->old) names.emplace_back(k->name);
  return names;
}

const Key* KeyTable::find(std::string_view table, std::string_view name) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(),
                                  [&](const Key& k) { return k.table == table && k.name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

const Key& KeyTable::row(std::string_view table, std::string_view name) const {
  const Key* found = find(table, name);
  assert(found);
  return *found;
}

std::vector<std::string> split_words(std::string_view list) {
  std::vector<std::string> out;
  while (!list.empty()) {
    const auto end = std::min(list.find(' '), list.size());
    if (end > 0) out.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return out;
}

std::string_view type_text(ValueType t) { return type_texts[static_cast<std::size_t>(t)]; }
std::string_view range_text(Range r) { return range_texts[static_cast<std::size_t>(r)]; }

bool in_range(Range r, double v) {
  switch (r) {
    case any:
      return true;
    case positive:
      return v > 0.0;
    case not_negative:
      return v >= 0.0;
    case fraction:
      return v >= 0.0 && v <= 1.0;
    case poisson:
      return v > -1.0 && v < 0.5;
    case above_one:
      return v > 1.0;
  }
  return false;
}

}  // namespace tripoint
