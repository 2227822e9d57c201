// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

namespace tripoint {

/// A column of a table: its title, and its place in a terminal and in Markdown.
struct Column {
  std::string title;
  /// Characters in a terminal, below 0 where text ends on the right; 0 = as wide as its text
  int width = 0;
  bool is_number = false;  ///< Markdown: text ends on the right
};

/// A table that is written row by row, for Markdown or for a terminal. Cells are text that is safe where it
/// is written.
class TextTable {
 public:
  using Cells = std::vector<std::string>;

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// @pre a cell for each column
  void add(Cells cells);
  /// A line of its own below the last row, in a terminal.
  void note(const std::string& line) { notes_[rows_.size()] += line + "\n"; }
  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// Titles, the rule, and a line a row.
  [[nodiscard]] std::string markdown() const;
  /// Titles and a line a row, each behind `indent`; columns are separated by one space.
  [[nodiscard]] std::string text(const std::string& indent = {}) const;

 private:
  [[nodiscard]] std::string line_of(const Cells&) const;

  std::vector<Column> columns_;
  std::vector<Cells> rows_;
  std::map<std::size_t, std::string> notes_;  ///< behind this number of rows
};

}  // namespace tripoint
