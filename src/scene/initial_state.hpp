// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"

namespace tripoint {

/// Particles at time 0, row = id, SI: sampled once by the harness, the same for every engine.
struct InitialState {
  std::vector<Vec3> position, velocity;  ///< [m], [m/s]
  std::vector<double> mass;              ///< [kg]
  std::vector<double> temperature;       ///< [K]; empty where the scene has no temperature
  std::vector<int> phase;                ///< Phase
  std::vector<int> body;                 ///< row of the solid body (see body_rows), -1 for liquid
  std::vector<int> material;             ///< row in Scene::materials
  std::vector<int> source;               ///< row in Scene::bodies
  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Mass properties of one body from its particles.
struct MassProperties {
  double mass = 0.0;
  Vec3 centre;                ///< [m]
  Vec3 principal_inertia;     ///< ascending [kg m2]
  Quaternion principal_axes;  ///< principal frame to body (= world at the start) frame
};

}  // namespace tripoint
