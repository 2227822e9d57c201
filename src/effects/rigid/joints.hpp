// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

/// Joints of rigid bodies, [[joint]] (model 8.17), by RATTLE [Andersen 1983].
namespace tripoint::rigid {

/// Orientation of a free body after a time, by its angular momentum.
using Turned = Quaternion (*)(const State&, std::size_t body, double dt, bool as_printed);

/// @throws InputError where the velocities at the start break a joint
void check_joints_at_start(const State&);
/// Springs and motors of joints: half a kick.
void pull_by_joint_laws(State&, double dt);
/// Before a drift of dt: impulses after which the drift ends with every joint closed. @throws Diverged where
/// none do
void close_joints(State&, double dt, Turned turned, bool as_printed);
/// After the second half kick: impulses after which no joint opens.
void still_joints(State&, double dt);
[[nodiscard]] double joint_energy(const State&);  ///< of springs [J]
/// Greatest step that resolves the swing of each spring [s]; infinite where there is none.
[[nodiscard]] double joint_step(const State&);
[[nodiscard]] bool has_joint_effort(const Scene&);

}  // namespace tripoint::rigid
