// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

/// The cases that are shipped, by the names that people type: ids ("heat/cosine-mode") and subjects ("heat").
namespace tripoint {

/// Ids of the shipped cases, in alphabetical order; no file is opened.
[[nodiscard]] std::vector<std::string> shipped_ids();

/// The file of a case that is given as a path, with or without its .toml, or an id. @throws InputError with
/// the nearest id
[[nodiscard]] std::string case_file(const std::string& path_or_id);

/// The folder of a subject of the shipped cases ("heat"); empty when there is none of this name.
[[nodiscard]] std::string subject_folder(const std::string& subject);

/// "x: is no case file, no folder and no case id (did you mean `y`?)"
[[nodiscard]] std::string no_such_case(const std::string& what);

}  // namespace tripoint
