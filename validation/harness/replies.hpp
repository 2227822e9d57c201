// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/harness/discover.hpp"

/// What an engine prints, read: anything may stand in it, and nothing of it is an exception.
namespace tripoint {

/// The entry with all that `--info` printed. What is not by the contract leaves it not available, with the reason and the name
/// that it had.
[[nodiscard]] EngineEntry with_info(EngineEntry, const std::string& printed);

/// Why the engine cannot run the job, by what `--check` printed; empty = it can.
[[nodiscard]] std::string refusal_in(const std::string& printed);

}  // namespace tripoint
