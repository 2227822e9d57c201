// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "validation/references/reference.hpp"

/// Measured data: a table beside the case, `<case>.ref.csv`, that says where it comes from, in what unit and
/// how well it is known.
///
///     # source: J. C. Martin, W. J. Moyce, Phil. Trans. R. Soc. Lond. A 244 (1952) 312, figure 3
///     # unit time: 0.0539706 s           a value of the column times this is in SI
///     # unit front: 0.05715 m
///     # uncertainty front: 2 %           standard: of each value; without the sign, in the column's unit
///     # hash: fnv1a64:0123456789abcdef   of all other lines, so that no number changes unseen
///     time,front
///     1.219,1.474
///
/// Other comments are free text. The first column is the time, and it rises. Cells stand between commas,
/// semicolons, tabs or blanks (measured_cells.hpp). The header may have units, as "time [ms]"; a table
/// without header has `# columns: time, front`.
namespace tripoint {

struct Case;
struct Finding;

/// A data file as read.
struct ExperimentFile {
  std::string source;
  std::string first;                               ///< name of the first column
  std::map<std::string, MeasuredCurve> curves;     ///< by column; SI
  std::map<std::string, std::string> uncertainty;  ///< by column, as the file words it
};

/// @throws InputError naming file and line of an entry that is missing, unknown, not a number, not rising, of
/// another width, or changed since it was hashed
[[nodiscard]] ExperimentFile read_experiment(const std::string& path);

/// Likewise of a table whose first column is time, x, y or z; the curves' `time` is then that column.
[[nodiscard]] ExperimentFile read_table(const std::string& path);

/// Likewise of a text. @param path for messages
[[nodiscard]] ExperimentFile read_table_text(const std::string& path, const std::string& text);

/// FNV-1a over the lines without the one that begins with "# hash:" and without carriage returns, as it
/// stands in the file.
[[nodiscard]] std::string experiment_hash(const std::string& text);

/// Reads the data files of a case's references, so that nothing runs against data that cannot be used.
/// @throws InputError as read_experiment does
void check_data_files(const Case&);

/// Notes on data whose times go on after the end of the scene: those rows are compared with nothing.
[[nodiscard]] std::vector<Finding> data_after_the_end(const Case&);

/// The choice of a case with the source that its data file states, where the case names none and the file can
/// be read.
[[nodiscard]] ReferenceChoice with_source_of_file(ReferenceChoice);

}  // namespace tripoint
