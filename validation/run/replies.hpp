// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "validation/run/discover.hpp"

/// Reading of an engine's output: anything may stand in it, and nothing of it is an exception.
namespace tripoint {

/// The entry with why it is not available.
[[nodiscard]] EngineEntry unavailable(EngineEntry, const std::string& reason);

/// The entry with all that `--info` printed. Output that breaks the contract leaves the entry not available,
/// with the reason and the name that it had.
[[nodiscard]] EngineEntry with_info(EngineEntry, const std::string& printed);

/// Why an engine cannot run a job, in its own words or, where it has none, in ours.
struct Refusal {
  std::string reason;
  bool explained = true;  ///< in its own words
};
/// @param reason the engine's own words, "" where it gave none
[[nodiscard]] Refusal refusal_for(const std::string& reason);
/// Of the job, by what `--check` printed; empty = the engine can run it.
[[nodiscard]] std::optional<Refusal> refusal_in(const std::string& printed);

}  // namespace tripoint
