// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "files/status.hpp"

/// Output of an engine, result.json, contract 1.
namespace tripoint {

struct ReadbackBody {
  std::string name;
  double mass = 0.0;
  Vec3 centre, principal_inertia;
  double friction = 0.0, restitution = 0.0, linear_damping = 0.0, angular_damping = 0.0;
};

/// Laws of a joint as the engine holds them: those that a vendor has as it comes belong to no scene.
struct ReadbackJoint {
  std::string name;
  double damping = 0.0, friction = 0.0, stiffness = 0.0;  ///< as [[joint]] has them
  double armature = 0.0;                                  ///< inertia added to its coordinate [kg m2] or [kg]
};

struct Readback {
  Vec3 gravity;
  double time_step = 0.0;
  std::string precision = "double";
  std::vector<ReadbackBody> bodies;
  std::vector<ReadbackJoint> joints;
};

struct Divergence {
  long particle = -1, body = -1;
  std::string field, stage;
  double time = 0.0;
  std::string guard;  ///< which one tripped; empty = the engine has none
  /// In the run's folder: the culprit and its surroundings, for ParaView; empty = none
  std::string file;
  std::string checkpoint;  ///< last good one; empty = none
};

/// Contents of result.json.
struct Result {
  Status status = Status::ok;  ///< ok, refused, diverged or error
  std::string message;
  double time_reached = 0.0;
  long steps = 0;
  double pairs = 0.0, iterations = 0.0;
  double setup_wall = 0.0, setup_cpu = 0.0, stepping_wall = 0.0, stepping_cpu = 0.0;  ///< [s]
  std::string state_hash;
  std::string time_step_bound;  ///< which effect's bound set the step
  Readback readback;
  std::optional<Divergence> divergence;
  std::map<std::string, double> extra;  ///< further numbers, under "extra"
};

/// @throws InputError naming the file and the key that is missing, of the wrong kind, or a status that no
/// engine may give
[[nodiscard]] Result read_result(const std::string& path);
/// Writes to a temporary name, fsyncs and renames: the engine's last act.
void write_result(const std::string& path, const Result&);

}  // namespace tripoint
