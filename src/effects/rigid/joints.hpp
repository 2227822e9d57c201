// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "state/state.hpp"

/// Joints of rigid bodies, [[joint]] (model 8.17), by RATTLE [Andersen 1983].
namespace tripoint::rigid {

/// How bodies turn and what pushes them, for a drift that limits may part.
struct JointDrift {
  /// Orientation of a free body after a time, by its angular momentum.
  Quaternion (*turned)(const State&, std::size_t body, double dt, bool as_printed);
  bool as_printed;
  std::function<void(double dt)> kick;  ///< by all forces but those of joints
  std::function<void(double dt)> move;  ///< free bodies by their velocities
};

/// @throws InputError where the velocities at the start break a joint
void check_joints_at_start(const State&);
/// Dampers before the first half kick, by the rates before it; after the second still_joints() has them.
void damp_joints(State&, double dt);
/// Springs and motors of joints: half a kick.
void pull_by_joint_laws(State&, double dt);
/// A drift of dt: impulses before it after which it ends with every joint closed. It parts where a joint hits
/// a limit. @throws Diverged where no impulses close them
void drift_with_joints(State&, double dt, const JointDrift&);
/// After the second half kick: impulses after which no joint opens.
void still_joints(State&, double dt);
[[nodiscard]] double joint_energy(const State&);  ///< of springs [J]
/// Greatest step that resolves the swing of each spring and the decay by each damper [s]; infinite where
/// there is none.
[[nodiscard]] double joint_step(const State&);
/// Whether a joint takes or gives energy by more than a spring.
[[nodiscard]] bool has_joint_work(const Scene&);

}  // namespace tripoint::rigid
