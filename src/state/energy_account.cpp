// SPDX-License-Identifier: BSD-3-Clause
#include "state/energy_account.hpp"

#include <cassert>

namespace tripoint {

EnergyAccounts::EnergyAccounts() {
  for (const EnergyAccount& a :
       {account::gravity_work, account::start_potential, account::driven_potential, account::rotation_drift,
        account::deformation_released, account::inflow, account::merging, account::walls})
    open(a);
}

void EnergyAccounts::open(const EnergyAccount& a) {
  if (has(a)) return;
  assert(values_.size() < places / 2);
  names_.push_back(a.name);
  keys_.push_back(a.key);
  values_.push_back(0.0);
  std::size_t s = a.key % places;
  while (number_[s] != 0) s = (s + 1) % places;
  number_[s] = static_cast<std::uint8_t>(values_.size());
}

}  // namespace tripoint
