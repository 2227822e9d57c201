// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"
#include "scene/geometry.hpp"
#include "state/failure.hpp"
#include "state/state.hpp"

/// Guards that belong to no single effect; those of effects are in their check(). Each names particle, body,
/// field, stage and time, and changes nothing.
namespace tripoint {

/// Looks for values that are not finite, in the order in which a step writes fields, so that the first wrong
/// one is named. Also looks for temperatures at or below 0 K, which conduction never makes of a start above
/// it.
/// @throws Diverged
void check_finite(const State&);

/// Where particles may be: the scene's domain with one spacing around it or, where it gives none,
/// escape_domain().
struct Enclosure {
  Bounds box;
  bool given = false;  ///< by the scene
};
[[nodiscard]] Enclosure enclosure_of(const Scene&, const InitialState&);

/// Looks for particles that no keyframe moves and that are outside, where the domain is not periodic. @throws
/// Diverged
void check_escape(const State&, const Enclosure&);

/// Memory of the guards about a run; a checkpoint keeps it.
struct GuardMemory {
  double turned_over = 0.0;  ///< greatest sum of the sizes of all entries of the ledger so far [J]
  double first_step = 0.0;   ///< first finite bound [s]
  /// The scene was laid at rest, of liquids and fixed bodies alone: any motion then is a fall, or is made by
  /// the scheme
  bool still = false;
};

/// Compares energy that the scheme makes or loses with all that the scene has turned over. More than half of
/// that is no error of integration any more. Such energy is the entry "time_integration", and any energy made
/// by viscous forces, walls included, which may only take. In a scene that was laid at rest, energy made by
/// the printed pressure counts too. Below a ten-billionth of the energy that the mass would have at one
/// spacing a step nothing is told apart from round-off.
/// @throws Diverged naming the particle of the greatest kinetic energy
void check_energy(const State&, const Ledger&, double start_potential, double dt, GuardMemory&);

/// A step that shrinks to a hundred-thousandth of the first goes on, if at all, for ever.
/// @throws Diverged naming the bound and the particle of the greatest kinetic energy
void check_step(const State&, const TimeStepBound&, GuardMemory&);

/// @throws Diverged: the steps to the next output would be more than can be made
[[noreturn]] void refuse_small_step(const State&, double dt, double length, const std::string& name);

/// @throws Diverged: the step that the scene chose has come to lie above a bound
[[noreturn]] void refuse_step(const State&, double dt, double bound, const std::string& name);

}  // namespace tripoint
