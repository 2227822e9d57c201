// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint {

/// Two: one layer of particles in the plane y = 0. Volumes, masses and forces are those of a layer 1 m deep.
enum class Dimensions : int { two = 2, three = 3 };

inline constexpr double layer_depth = 1.0;  ///< along y, in two dimensions [m]

[[nodiscard]] constexpr double number_of(Dimensions d) noexcept { return static_cast<double>(d); }

/// Volume that a particle of the lattice fills [m3]. @param spacing dx > 0 [m]
[[nodiscard]] constexpr double cell_volume(double spacing, Dimensions d) noexcept {
  return d == Dimensions::three ? spacing * spacing * spacing : spacing * spacing * layer_depth;
}

}  // namespace tripoint
