// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_sums.hpp"

#include "core/machine.hpp"

namespace tripoint::elastic {

BondSums bond_sums(const BondForms& forms) {
  return machine_has_avx2() ? bond_sums_for<Avx2>(forms) : bond_sums_for<Any>(forms);
}

}  // namespace tripoint::elastic
