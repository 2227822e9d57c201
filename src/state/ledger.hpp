// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>

#include "core/vec3.hpp"

namespace tripoint {

struct State;

/// Quantities that a closed system conserves, summed in order of id, and its energy by entry.
struct Ledger {
  double mass = 0.0;                     ///< [kg]
  Vec3 momentum;                         ///< [kg m/s]
  Vec3 angular_momentum;                 ///< about the origin [kg m2/s]
  std::map<std::string, double> energy;  ///< entry -> [J]: kinetic potential thermal merging walls ...
};

/// Keeps the energy stored at time 0, which later ledgers are compared with.
void accumulate_start(State&, const Ledger&);

/// Tells the work of all forces (model 8.11). For forces that store energy, it tells also the difference by
/// finite steps between work and store.
/// @param sum what effects tell of themselves
void close_ledger(const State&, Ledger& sum);

}  // namespace tripoint
