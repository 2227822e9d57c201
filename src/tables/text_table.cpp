// SPDX-License-Identifier: BSD-3-Clause
#include "tables/text_table.hpp"

#include <fmt/format.h>

#include <cassert>

namespace tripoint {
namespace {

std::string markdown_line(const TextTable::Cells& cells) {
  return "| " + fmt::format("{}", fmt::join(cells, " | ")) + " |\n";
}

TextTable::Cells titles_of(const std::vector<Column>& columns) {
  TextTable::Cells titles;
  for (const auto& column : columns) titles.push_back(column.title);
  return titles;
}

}  // namespace

void TextTable::add(Cells cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string TextTable::markdown() const {
  std::string text, rule = "|";
  for (const auto& column : columns_)
    text += column.title.empty() ? "| " : fmt::format("| {} ", column.title);
  text += "|\n";
  for (const auto& column : columns_) rule += column.is_number ? "---:|" : "---|";
  text += rule + "\n";
  for (const auto& row : rows_) text += markdown_line(row);
  return text;
}

std::string TextTable::line_of(const Cells& cells) const {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += ' ';
    const int width = columns_[k].width;
    line += width < 0 ? fmt::format("{:>{}}", cells[k], -width) : fmt::format("{:<{}}", cells[k], width);
  }
  return line + "\n";
}

std::string TextTable::text(const std::string& indent) const {
  std::string text = indent + line_of(titles_of(columns_));
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    text += indent + line_of(rows_[n]);
    if (const auto note = notes_.find(n + 1); note != notes_.end()) text += note->second;
  }
  return text;
}

}  // namespace tripoint
