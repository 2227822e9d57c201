// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

/// Folder of cases, material library and assets: share/tripoint beside the executable's folder.
[[nodiscard]] std::string share_folder();

/// Path of a text for the list of a material library, "" when the library has none of that name.
[[nodiscard]] std::string library_file(const std::string& material);
[[nodiscard]] std::vector<std::string> library_names();

}  // namespace tripoint
