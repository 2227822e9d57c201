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
  double pressure_work = 0.0;     ///< done by pressure on liquids and free bodies [J]
  double viscous_work = 0.0;      ///< done by viscous forces on liquids and free bodies: what they dissipate leaves as minus this [J]
  double bulk_viscous = 0.0;      ///< taken by the numerical bulk viscosity of liquids [J]
  double gravity_work = 0.0;      ///< done by gravity on liquids and free bodies [J]
  double wall_pressure_work = 0.0;  ///< done by pressure on driven walls [J]
  double wall_viscous_work = 0.0;   ///< done by viscous forces on driven walls [J]
  double elastic_work = 0.0;      ///< done by bonds, of strain energy and hourglass energy, on liquids, deformable solids and free bodies [J]
  double wall_elastic_work = 0.0;   ///< done by bonds on driven walls [J]
  double deformation_released = 0.0;  ///< elastic and hourglass energy that events turned into heat, plastic or fracture entries [J]
  double compression_released = 0.0;  ///< energy of compression that changes of phase and of own pairs let go [J]
  double plastic = 0.0, fracture = 0.0;  ///< dissipated by plastic flow; let go by broken bonds [J]
  double transport_work = 0.0;      ///< done on liquids by the stress of the transport velocity [J]
  double rotation_drift = 0.0;      ///< change of kinetic energy by the free rotation of bodies, which a scheme does not keep exactly [J]
  double driven_potential = 0.0;    ///< change of the potential energy of driven bodies [J]
  double start_compression = 0.0, start_potential = 0.0, start_deformation = 0.0;  ///< stored at time 0 [J]
  double inflow = 0.0;            ///< kinetic, potential and thermal energy that flowed in [J]
  double merging = 0.0;           ///< kinetic energy lost as bodies became one [J]
  double walls = 0.0;             ///< taken by what is held, fixed or prescribed from outside [J]
  Vec3 undelivered_spin;          ///< angular momentum about truncated axes that a split could not hand on [kg m2/s]
};

}  // namespace tripoint
