// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Lists of keys of a case file. The reader's checks, the JSON Schema and the reference page come from them.
namespace tripoint {

enum class ValueType {
  number,
  integer,
  flag,
  text,
  word,
  vector,
  numbers,
  texts,
  number_or_auto,
  text_or_texts,  ///< "a" or ["a", "b"]
  words,          ///< array of words
  table,
  tables,    ///< a sub-table of its own rows; an array of such
  settings,  ///< a table of free keys
  shape,
  temperature,
  velocity,
  invariant,  ///< a limit, or a table of its metric and its gate
};

enum class Range { any, positive, not_negative, fraction, poisson, above_one };

struct Key {
  std::string_view table;  ///< "scene", "body", "shape.box" ...
  std::string_view name;
  ValueType type;
  std::string_view unit;  ///< SI; "" = plain number
  Range range;
  /// "!" required, "" absent = not set, "=" by a rule of the reader, else the value as TOML text
  std::string_view fallback;
  std::string_view note;     ///< reason of the fallback (or, where nothing is set, what that means)
  std::string_view words;    ///< allowed words, separated by blanks; of a table: its name in this list
  std::string_view meaning;  ///< one line
  bool old = false;          ///< read in old files, and on no page: a word of [model] says it now

  [[nodiscard]] bool required() const { return fallback == "!"; }
};

/// A table of the list: its title for the page, and how it is written.
struct TableInfo {
  std::string_view name, written, meaning;
};

/// Tables and their keys, in the order of the reference page.
class KeyTable {
 public:
  KeyTable(std::vector<Key> rows, std::vector<TableInfo> tables)
      : rows_(std::move(rows)), tables_(std::move(tables)) {}
  [[nodiscard]] const std::vector<Key>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<TableInfo>& tables() const { return tables_; }
  /// Rows of one table. Empty = no such table.
  [[nodiscard]] std::vector<const Key*> of(std::string_view table) const;
  /// Names of one table that a new file may have.
  [[nodiscard]] std::vector<std::string> names(std::string_view table) const;
  [[nodiscard]] bool has(std::string_view table, std::string_view name) const { return find(table, name); }
  /// @pre the key exists
  [[nodiscard]] const Key& row(std::string_view table, std::string_view name) const;

 private:
  [[nodiscard]] const Key* find(std::string_view table, std::string_view name) const;

  std::vector<Key> rows_;
  std::vector<TableInfo> tables_;
};

[[nodiscard]] std::vector<std::string> split_words(std::string_view words);
[[nodiscard]] std::string_view type_text(ValueType);
[[nodiscard]] std::string_view range_text(Range);  ///< "greater than 0" ...; "" for any
[[nodiscard]] bool in_range(Range, double);

}  // namespace tripoint
