// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdexcept>
#include <utility>

#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

namespace tripoint {

/// How far settled() came.
struct Settling {
  long steps = 0;      ///< of relaxation
  double speed = 0.0;  ///< greatest rms speed of the liquids in the last cycle [m/s]
  double goal = 0.0;   ///< below it they count as settled [m/s]
};

/// Someone wants the program to end before the liquids have come to rest.
class SettlingStopped : public std::runtime_error {
 public:
  SettlingStopped()
      : std::runtime_error("stopped while the liquids were let down into equilibrium (scene.settle)") {}
};

/// Asked at every step of settled(), which takes up to minutes; nullptr, as at the start: nobody stops it.
void stop_settling_when(bool (*wanted)() noexcept) noexcept;

/// Particles of a scene with `settle = true`. Its liquids are let down into equilibrium under gravity between
/// the solids, which stand still where they are at the start. A lattice is no equilibrium of a liquid with a
/// free surface. Left alone it falls by a tenth of a spacing, breaks up, and moves at some percent of sqrt(g
/// H) for seconds.
///
/// Kinetic damping [Barnes 1999]: an inviscid run, all velocities put to zero whenever the kinetic energy has
/// passed a peak, until the peaks are low. The corrected forms serve in every mode, so that all runs of a
/// case start from the same particles. Velocities and temperatures are as before.
/// @param initial what sample() gives   @param how far it came, where asked
/// @returns the same particles, those of liquids moved [m]; `initial` itself where the scene does not ask for
/// it
/// @throws InputError where a solid is free to move, or nothing pulls; SettlingStopped
[[nodiscard]] InitialState settled(const Scene&, InitialState initial, Settling* how);
/// The same, as sample() calls it.
[[nodiscard]] inline InitialState settled(const Scene& scene, InitialState initial) {
  return settled(scene, std::move(initial), nullptr);
}

}  // namespace tripoint
