// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>

#include "core/vec3.hpp"

namespace tripoint {

struct World;

/// What a closed system keeps, summed in order of id, and where energy is.
struct Ledger {
  double mass = 0.0;                     ///< [kg]
  Vec3 momentum;                         ///< [kg m/s]
  Vec3 angular_momentum;                 ///< about the origin [kg m2/s]
  std::map<std::string, double> energy;  ///< entry -> [J]: kinetic potential thermal merging walls ...
};

/// Keeps what is stored at time 0, which later ledgers are compared with.
void book_start(World&, const Ledger&);

/// Tells the work of all forces, and what finite steps leave between the work of those that store energy and what they store
/// (model 8.11).
/// @param sum what effects tell of themselves
void close_ledger(const World&, Ledger& sum);

}  // namespace tripoint
