// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/measured_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/errors.hpp"
#include "tables/nearest.hpp"
#include "tables/units.hpp"
#include "validation/references/experiment.hpp"
#include "validation/references/measured_cells.hpp"

namespace tripoint {
namespace {

/// A table in parts.
struct Parts {
  std::vector<std::string> above;  ///< lines above the rows: comments, a title, a header
  std::vector<std::string> rows;
};

bool is_row(const std::string& line) {
  const auto cells = cells_of(line);
  return cells.size() > 1 && are_numbers(cells);
}

Parts parts_of(const std::string& text) {
  Parts parts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // the mark of UTF-8
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (trimmed(line).empty()) continue;
    if (parts.rows.empty() && !is_row(line))
      parts.above.push_back(line);
    else
      parts.rows.push_back(line);
  }
  return parts;
}

/// Names that digitised tables have for the first column.
std::string first_name(const std::string& name) {
  return name == "t" || name == "T" || name == "Time" ? "time" : name;
}

/// A column with what is known of it.
struct Column {
  std::string name, unit, uncertainty;  ///< the unit as a line of the file has it
};

/// "0.001 m"
std::string unit_line(const std::string& unit) {
  const Unit u = parse_unit(unit);
  if (u.offset != 0.0)
    throw std::invalid_argument("`" + printable(unit) + "` has another zero than the SI unit: give K");
  return fmt::format("{} {}", u.numerator / u.denominator, to_string(u.dimension));
}

class Maker {
 public:
  Maker(std::string path, const TableWords& words) : path_(std::move(path)), words_(words) {}

  std::string text(const Parts& parts) {
    if (parts.rows.empty()) refuse("it has no row of two numbers or more");
    take_columns(parts);
    for (auto& column : columns_) complete(column);
    if (words_.source.empty()) lacks_.emplace_back("its source (--source TEXT)");
    if (!lacks_.empty()) refuse(fmt::format("it does not say {}", fmt::join(lacks_, ", ")));
    return with_hash(parts);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError({path_, 0, 0}, what); }

  void take_columns(const Parts& parts) {
    const std::size_t count = cells_of(parts.rows.front()).size();
    if (!words_.columns.empty()) {
      for (const auto& name : words_.columns) columns_.push_back({name, "", ""});
    } else {
      const auto header = std::ranges::find_if(
          parts.above.rbegin(), parts.above.rend(),
          [&](const auto& line) { return !line.starts_with('#') && cells_of(line).size() == count; });
      if (header != parts.above.rend()) take_header(*header);
    }
    if (columns_.empty()) {
      lacks_.emplace_back("the names of its columns (--columns time,NAME)");
    } else if (columns_.size() != count) {
      refuse(fmt::format("{} columns are named, and its rows have {}", columns_.size(), count));
    } else if (const auto& first = columns_.front().name;
               first != "time" && first != "x" && first != "y" && first != "z") {
      lacks_.push_back(
          fmt::format("time, x, y or z of its first column, `{}` (--columns time,NAME)", printable(first)));
    }
  }

  void take_header(const std::string& line) {
    for (const auto& cell : cells_of(line)) {
      const std::size_t open = cell.find_first_of("[(");
      const std::size_t slash = cell.find(" / ");
      std::string unit;
      if (open != cell.npos && cell.size() > open + 2)
        unit = trimmed(cell.substr(open + 1, cell.size() - open - 2));
      else if (slash != cell.npos)
        unit = trimmed(cell.substr(slash + 3));
      columns_.push_back({trimmed(cell.substr(0, std::min(open, slash))), unit, ""});
    }
    columns_.front().name = first_name(columns_.front().name);
  }

  void complete(Column& column) {
    const auto said = [&](const std::map<std::string, std::string>& words) {
      const auto at = words.find(column.name);
      return at == words.end() ? std::string() : at->second;
    };
    if (const auto unit = said(words_.units); !unit.empty()) column.unit = unit;
    column.uncertainty = said(words_.uncertainties);
    const std::string name = printable(column.name);
    try {
      if (column.unit.empty())
        lacks_.push_back(fmt::format("the unit of {0} (--unit {0}=UNIT)", name));
      else
        column.unit = unit_line(column.unit);
    } catch (const std::invalid_argument& e) {
      lacks_.push_back(fmt::format("a known unit of {0} (--unit {0}=UNIT): {1}", name, e.what()));
    }
    if (column.uncertainty.empty() && &column != &columns_.front())
      lacks_.push_back(fmt::format("the standard uncertainty of {0} (--uncertainty {0}='2 %')", name));
  }

  [[nodiscard]] std::string with_hash(const Parts& parts) const {
    std::string head = fmt::format("# source: {}\n", words_.source), names, rows;
    for (const auto& line : parts.above)
      head += (line.starts_with('#') ? "" : "# as it came, ") + line + "\n";
    for (const auto& column : columns_) {
      head += fmt::format("# unit {}: {}\n", column.name, column.unit);
      if (!column.uncertainty.empty())
        head += fmt::format("# uncertainty {}: {}\n", column.name, column.uncertainty);
      names += (names.empty() ? "" : ", ") + column.name;
    }
    head += "# columns: " + names + "\n";
    for (const auto& row : parts.rows) rows += row + "\n";
    return head + "# hash: " + experiment_hash(head + rows) + "\n" + rows;
  }

  std::string path_;
  const TableWords& words_;
  std::vector<Column> columns_;
  std::vector<std::string> lacks_;
};

}  // namespace

std::string reference_table(const std::string& path, const std::string& text, const TableWords& words) {
  const std::string made = Maker(path, words).text(parts_of(text));
  static_cast<void>(read_table_text(path, made));
  return made;
}

}  // namespace tripoint
