// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Entries of the ledger of energy that more than one room names. Those of a single effect are in its rule.
namespace tripoint::ledger_entry {

inline constexpr const char* kinetic = "kinetic";
inline constexpr const char* potential = "potential";
/// What finite time steps have made, lost where negative
inline constexpr const char* time_integration = "time_integration";

}  // namespace tripoint::ledger_entry
