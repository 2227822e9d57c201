// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace tripoint {

/// JSON Schema of the case file, and its reference page in Markdown: both from the one key table.
[[nodiscard]] std::string case_schema();
[[nodiscard]] std::string case_reference_page();
/// Text of a new case file that runs on defaults.
[[nodiscard]] std::string new_case_text(const std::string& id);
/// Text of a new case file made of a template, cases/templates/FROM.toml. @throws InputError naming the
/// templates
[[nodiscard]] std::string new_case_text(const std::string& id, const std::string& from);

}  // namespace tripoint
