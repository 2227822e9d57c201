// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json_fwd.hpp>

namespace tripoint {

/// JSON Schemas (2020-12) of JOB.json and of result.json, from the records that they are read and written by.
/// Each table has its place in `$defs`; a description is the meaning with the unit in brackets. What is not
/// required may be null or missing.
[[nodiscard]] nlohmann::ordered_json job_schema();
[[nodiscard]] nlohmann::ordered_json result_schema();

}  // namespace tripoint
