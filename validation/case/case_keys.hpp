// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/key_table.hpp"

namespace tripoint {

/// The one list of what a case file may say: the scene's keys, and those of how it is judged. The reader's checks, the JSON
/// Schema and the reference page come from it.
[[nodiscard]] const KeyTable& case_keys();

}  // namespace tripoint
