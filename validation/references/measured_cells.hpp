// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Rows of tables as measuring and digitising programs write them: cells between tabs, semicolons, commas or
/// blanks, with decimal points or decimal commas.
namespace tripoint {

/// Without the blanks around it.
[[nodiscard]] std::string trimmed(std::string_view);

/// Cells of a row, each trimmed. A decimal comma becomes a point where commas do not part cells.
[[nodiscard]] std::vector<std::string> cells_of(const std::string& line);

/// Whether every cell is a number.
[[nodiscard]] bool are_numbers(const std::vector<std::string>& cells);

/// A column's name and, where the header has it, its unit in SI: "x [mm]", "time (s)", "p / kPa".
struct NamedColumn {
  std::string name;
  std::optional<double> unit;
};
/// @throws std::invalid_argument where the unit is unknown, or has another zero than the SI unit
[[nodiscard]] NamedColumn named_column(const std::string& cell);

}  // namespace tripoint
