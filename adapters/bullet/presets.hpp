// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "files/job.hpp"

/// Bullet's numbers that change results: three presets, and the settings of a case over them.
namespace tripoint::bullet {

enum class Gyro { off, explicit_world, implicit_body, implicit_world };
/// The case's own box or sphere; one box (sphere) a particle; or bodies that pass through each other.
enum class Collision { solid, boxes, spheres, none };

struct Preset {
  int iterations = 10;  ///< of the sequential impulse solver
  double erp2 = 0.2;    ///< share of the penetration that is removed in a step
  /// Deeper penetrations than this are corrected apart from the velocity [m]
  double split_threshold = -0.04;
  double restitution_threshold = 0.2;  ///< slower hits than this do not bounce [m/s]
  double contact_threshold = 1e30;     ///< contacts act from this distance on [m]
  double restitution = 0.0;            ///< of a pair of bodies
  double friction = 0.0;               ///< Coulomb's coefficient, of a pair of bodies
  Gyro gyro = Gyro::implicit_body;
  Collision collision = Collision::solid;
};

[[nodiscard]] std::vector<std::string> preset_names();
/// Key -> meaning and default, for --info.
[[nodiscard]] std::map<std::string, std::string> setting_help();
/// The job's preset with its settings applied. @throws InputError naming an unknown preset, key or word
[[nodiscard]] Preset preset_for(const Job&);

}  // namespace tripoint::bullet
