// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "effects/solid_lab.hpp"
#include "step/stability_map.hpp"

/// What the points of the maps share: disturbances, what is watched of a run, and the fastest modes of a
/// scene's own forces and rates.
namespace tripoint::stability {

/// Particles of a periodic box: its shortest waves are those of the endless lattice
inline constexpr int side = 4;
inline constexpr long steps = 100;  ///< one per cent beyond the frontier grows by e^28 in as many

/// Random velocities of every particle, each component up to `speed` [m/s].
void disturb(lab::Lab&, double speed);
[[nodiscard]] double kinetic(const Simulation&);
/// The step that the solver takes by itself at the start [s].
[[nodiscard]] double own_step(const lab::Lab&);
/// Whether `measure` of a run at this step stays below `most`.
[[nodiscard]] std::function<bool(double)> stays(lab::Lab, std::function<double(const Simulation&)> measure,
                                                double most);

/// 2/omega of the fastest small oscillation of a scene's liquid particles and rigid bodies about their start
/// [s], by power iteration on their own forces. @param turns whether bodies turn too; they are then cubes,
/// alike about all axes
[[nodiscard]] double oscillation_limit(const lab::Lab&, bool turns);
/// 2/lambda of the fastest decay of temperatures [s], by power iteration on their rates.
[[nodiscard]] double conduction_limit(const lab::Lab&);
/// 2/lambda of the fastest decay of velocities of a liquid [s], by power iteration on its viscous forces.
[[nodiscard]] double friction_limit(const lab::Lab&);
/// 2/omega of the fastest mode of a deformable block [s], by power iteration on its own forces.
[[nodiscard]] double elastic_limit(const lab::Lab&, lab::Deformable);

/// Bodies in contact and afloat, light beside heavy.
void add_contact_points(std::vector<Point>&);
/// Where the matter is not one lattice of one kind: jumps, jitter, frozen solids, other hourglass stiffness,
/// printed heat.
void add_mixed_points(std::vector<Point>&);

}  // namespace tripoint::stability
