// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/harness/discover.hpp"

/// Reading of an engine's output: anything may stand in it, and nothing of it is an exception.
namespace tripoint {

/// The entry with all that `--info` printed. Output that breaks the contract leaves the entry not available, with the reason and
/// the name that it had.
[[nodiscard]] EngineEntry with_info(EngineEntry, const std::string& printed);

/// Why the engine cannot run the job, by what `--check` printed; empty = it can.
[[nodiscard]] std::string refusal_in(const std::string& printed);

}  // namespace tripoint
