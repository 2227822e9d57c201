// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tables/key_table.hpp"

namespace tripoint {

/// The one list of the keys of a case file: the scene's keys, and those of its judgement. The reader's
/// checks, the JSON Schema and the reference page come from it.
[[nodiscard]] const KeyTable& case_keys();

}  // namespace tripoint
