// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>

#include "core/vec3.hpp"

namespace tripoint {

/// What a closed system keeps, summed in order of id, and where energy is.
struct Ledger {
  double mass = 0.0;                     ///< [kg]
  Vec3 momentum;                         ///< [kg m/s]
  Vec3 angular_momentum;                 ///< about the origin [kg m2/s]
  std::map<std::string, double> energy;  ///< entry -> [J]: kinetic potential thermal merging walls ...
};

/// What left the stored energies for good, booked as it happens.
struct Booked {
  double merging = 0.0;   ///< kinetic energy lost as bodies became one [J]
  double walls = 0.0;     ///< taken by what is held, fixed or prescribed from outside [J]
  Vec3 undelivered_spin;  ///< angular momentum about truncated axes that a split could not hand on [kg m2/s]
};

}  // namespace tripoint
