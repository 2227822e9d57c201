// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "files/reference_choice.hpp"
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"
#include "tables/settings.hpp"

/// Input of an engine, JOB.json, contract 1.
namespace tripoint {

/// One body of a job: of every [[body]], liquid too, in the order of the case file.
struct JobBody {
  std::string name, material;
  int index = -1;  ///< row in /particles/bodies; -1 for a liquid
  Phase phase = Phase::rigid;
  Motion motion = Motion::free;
  std::vector<Keyframe> keyframes;
  bool temperature_held = false;
  MassProperties properties;  ///< of its particles
  Quaternion orientation;     ///< (1,0,0,0) at the start
  Vec3 velocity;              ///< of the centre of mass [m/s]
  Vec3 angular_velocity;      ///< world frame [rad/s]
};

/// A number that the case asks for at a point, or of a body or region. A solver of fields may answer these
/// alone.
struct JobGauge {
  /// Name of the case's metric; displacement, temperature_at, mean_temperature ...
  std::string metric, quantity;
  std::string body;  ///< empty = all
  /// Point, axis, min, max, outside, phase: those that the case states, never its value
  Settings where;
};

struct Resolution {
  double spacing = 0.0, support_ratio = 0.0;
  std::optional<double> time_step;  ///< empty = the engine's own choice
  std::optional<double> walkers, iterations;
};

struct Job {
  std::string case_id;
  Scene scene;  ///< as checked, resolved for this run's mode, spacing, time step and seed
  std::vector<JobBody> bodies;
  std::string particles;  ///< path of particles.h5
  Resolution resolution;
  std::string preset = "default";
  Settings settings;
  ReferenceChoice reference;  ///< for the engine `exact` only
  std::uint64_t seed = 1;
  int threads = 1, ranks = 1;
  std::vector<JobGauge> gauges;
  std::vector<double> times;  ///< output times, t0 .. end [s]
  std::string output;         ///< folder
  std::string resume;         ///< checkpoint to continue from; empty = none
};

/// @throws InputError naming the key that is missing or of the wrong kind. Relative paths inside count from
/// the file's folder.
[[nodiscard]] Job read_job(const std::string& path);
[[nodiscard]] std::string job_text(const Job&);
/// FNV-1a of a text, as 16 hex digits: tells two jobs apart.
[[nodiscard]] std::string text_hash(const std::string&);
void write_job(const std::string& path, const Job&);

}  // namespace tripoint
