// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/measured_cells.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "tables/units.hpp"

namespace tripoint {
namespace {

constexpr std::string_view blanks = " \t";

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t at = 0; at != std::string::npos; from = at + 1) {
    at = line.find(separator, from);
    cells.push_back(trimmed(std::string_view(line).substr(from, at == std::string::npos ? at : at - from)));
  }
  return cells;
}

std::vector<std::string> split_at_blanks(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t from = line.find_first_not_of(blanks); from != std::string::npos;) {
    const std::size_t to = line.find_first_of(blanks, from);
    cells.push_back(line.substr(from, to == std::string::npos ? to : to - from));
    from = to == std::string::npos ? to : line.find_first_not_of(blanks, to);
  }
  return cells;
}

bool is_number(const std::string& cell) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size();
}

/// "0,5" is a number with a decimal comma.
std::string with_point(std::string cell) {
  if (std::ranges::count(cell, ',') != 1 || cell.find('.') != cell.npos) return cell;
  std::string pointed = cell;
  std::ranges::replace(pointed, ',', '.');
  return is_number(pointed) ? pointed : cell;
}

}  // namespace

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks), last = text.find_last_not_of(blanks);
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

bool are_numbers(const std::vector<std::string>& cells) { return std::ranges::all_of(cells, is_number); }

std::vector<std::string> cells_of(const std::string& line) {
  for (const char separator : {'\t', ';'}) {
    if (line.find(separator) == line.npos) continue;
    auto cells = split(line, separator);
    std::ranges::transform(cells, cells.begin(), with_point);
    return cells;
  }
  auto by_blanks = split_at_blanks(line);
  std::ranges::transform(by_blanks, by_blanks.begin(), with_point);
  if (by_blanks.size() > 1 && are_numbers(by_blanks)) return by_blanks;
  return split(line, ',');
}

NamedColumn named_column(const std::string& cell) {
  const std::size_t open = cell.find_first_of("[(");
  const bool in_brackets = open != cell.npos && (cell.back() == ']' || cell.back() == ')');
  const std::size_t slash = cell.find(" / ");
  if (!in_brackets && slash == cell.npos) return {cell, {}};
  const std::string text = in_brackets ? cell.substr(open + 1, cell.size() - open - 2)
                                       : trimmed(std::string_view(cell).substr(slash + 3));
  const Unit unit = parse_unit(trimmed(text));
  if (unit.offset != 0.0)
    throw std::invalid_argument("`" + text + "` has another zero than the SI unit: give the values in K");
  return {trimmed(std::string_view(cell).substr(0, in_brackets ? open : slash)),
          unit.numerator / unit.denominator};
}

}  // namespace tripoint
