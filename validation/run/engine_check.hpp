// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

/// Compliance test of an engine executable with the contract.
namespace tripoint {

struct EngineCheck {
  std::string what;  ///< the sentence that must hold
  bool passed = false;
  std::string found;  ///< the result found instead
};

/// Asks --info, hands over broken jobs, and runs small scenes, of which the engine must be able to do one.
/// They are the flight of one body and, where it says `heat`, conduction. Checks result, times, ids, masses
/// and units. Where the engine says deterministic, a second run must be the same.
[[nodiscard]] std::vector<EngineCheck> check_engine(const std::string& executable);

/// A case that the check runs, as text of a case file.
struct CheckScene {
  std::string name, text;
  std::string capability;  ///< run where one of the engine's begins with this; empty = by every engine
};
[[nodiscard]] const std::vector<CheckScene>& check_scenes();

}  // namespace tripoint
