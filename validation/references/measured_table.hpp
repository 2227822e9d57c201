// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

/// A table as a measuring or digitising program wrote it, made a data file of a case (experiment.hpp).
namespace tripoint {

/// What the table itself may not say, by column.
struct TableWords {
  std::vector<std::string> columns;  ///< empty: those of its header
  std::string source;
  std::map<std::string, std::string> units;          ///< "mm"; a header may have them
  std::map<std::string, std::string> uncertainties;  ///< "2 %", or a number in the column's unit
};

/// The text of the data file: source, units, uncertainties, columns and hash above the rows as they are. A
/// title and a header become comments.
/// @param path for messages
/// @throws InputError naming at once all that is missing, each with the flag that says it
[[nodiscard]] std::string reference_table(const std::string& path, const std::string& text,
                                          const TableWords&);

}  // namespace tripoint
