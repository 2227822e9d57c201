// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_sums.hpp"

#include "core/machine.hpp"

namespace tripoint::elastic {

BondSums bond_sums(bool periodic, bool hourglass) {
  return machine_has_avx2() ? bond_sums_for<Avx2>(periodic, hourglass) : bond_sums_for<Any>(periodic, hourglass);
}

}  // namespace tripoint::elastic
