// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/references/liquid_scene.hpp"

namespace tripoint {

/// Liquid between two parallel walls that starts from rest, driven by a body force or by the walls.
struct ShearFlow {
  double width = 0.0;                        ///< between the walls [m]
  double kinematic_viscosity = 0.0;          ///< [m2/s]
  double drive = 0.0;                        ///< acceleration along the walls [m/s2]
  double low_speed = 0.0, high_speed = 0.0;  ///< of the walls [m/s]

  /// Speed at a distance from the low wall [m/s]: the steady profile less its sine series, which decays.
  [[nodiscard]] double speed(double distance, double time) const;
};

[[nodiscard]] std::vector<ReferenceArgument> plane_shear_arguments();
/// @throws InputError when the scene is no such channel
[[nodiscard]] std::unique_ptr<Reference> make_plane_shear(const ReferenceInput&, const char* function,
                                                          bool by_walls);

}  // namespace tripoint
