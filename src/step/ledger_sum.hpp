// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "assembly/all_effects.hpp"

namespace tripoint {

/// The ledger as this process has it: masses of its own particles in order of id, and the entries of each
/// effect.
[[nodiscard]] Ledger own_ledger(const State&, const std::vector<Active>&);

/// The same of all processes that share the scene, which all call it: all entries are sums over particles, or
/// told by one process alone.
[[nodiscard]] Ledger ledger_of_all(const State&, const std::vector<Active>&);

}  // namespace tripoint
