// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_sums.hpp"

/// Compiled once for each vector unit, and once for any machine.
namespace tripoint::elastic {

template <>
BondSums bond_sums_for<Unit>(const BondForms& forms) {
  return pick_bond_sums<Unit>(forms);
}

}  // namespace tripoint::elastic
