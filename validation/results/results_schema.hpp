// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

/// What a reader of results.json looks up, from the records that write and read it.
namespace tripoint {

/// JSON Schema of results.json.
[[nodiscard]] nlohmann::ordered_json results_schema();
/// The page docs/results.md.
[[nodiscard]] std::string results_page();

}  // namespace tripoint
