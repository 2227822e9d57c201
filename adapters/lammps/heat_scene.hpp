// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "files/job.hpp"
#include "files/result.hpp"
#include "files/trajectory.hpp"

/// Parts that walkers and sph/heatconduction share: heat in bodies at rest.
namespace tripoint::lammps {

/// Why this is no scene of pure conduction at rest; empty = it is.
[[nodiscard]] std::string why_no_conduction(const Job&);

/// Which material melts or freezes within the temperatures of the bodies and of the events; empty = none
/// does.
[[nodiscard]] std::string changing_phase(const Scene&);

/// k/(rho c) of a body [m2/s].
[[nodiscard]] double diffusivity(const Scene&, const Body&);
/// rho c of a body [J/m3/K].
[[nodiscard]] double heat_per_volume(const Scene&, const Body&);

/// Particles that never move, with the given temperatures.
[[nodiscard]] Snapshot at_rest(const Job&, const InitialState&, double time, long step,
                               std::vector<double> temperature);

/// Gravity does not act on bodies at rest; no bodies, as LAMMPS holds walkers or scaled particles of unit
/// mass.
[[nodiscard]] Readback rest_readback(const Job&, double time_step);

/// The one box that the bodies fill, in cells of one spacing.
struct CellBox {
  Vec3 min, max;
  std::array<int, 3> cells{};
  /// The body reaches across the periodic domain; else an insulated wall, unless it is held
  std::array<bool, 3> periodic{};
  int held_axis = -1;                         ///< across the faces whose temperature is held; -1 = none is
  std::optional<double> held_low, held_high;  ///< temperatures of these faces [K]
};
/// Box of the bodies whose temperature is free; held bodies must be plates that cover whole faces of it.
/// @param why receives the reason where the bodies tile no such box
[[nodiscard]] std::optional<CellBox> cell_box(const Scene&, std::string& why);

/// Least and greatest temperature of a field in any place; for an expression, of the given particles' values.
struct Range {
  double least, greatest;
};
[[nodiscard]] Range range_of(const TemperatureField&, const std::vector<double>& particle_values);

}  // namespace tripoint::lammps
