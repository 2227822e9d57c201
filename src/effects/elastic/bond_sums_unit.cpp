// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_sums.hpp"

/// Compiled once for each vector unit, and once for any machine.
namespace tripoint::elastic {

template <>
BondSums bond_sums_for<Unit>(bool periodic, bool hourglass) {
  return pick_bond_sums<Unit>(periodic, hourglass);
}

}  // namespace tripoint::elastic
