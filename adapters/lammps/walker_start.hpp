// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <random>
#include <vector>

#include "adapters/lammps/heat_scene.hpp"

namespace tripoint::lammps {

/// Uniform and Gaussian numbers of a seed, the same on every machine (std's distributions are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< [0, 1)
  [[nodiscard]] double gaussian();

 private:
  std::mt19937_64 engine_;
};

/// Temperature beside a base as a density to draw walkers from: T(r) = base(r) + (content / N) n(r), n the
/// number density of walkers with their signs. The base is the field's least value, so that all walkers count
/// as +1. Between held faces it is the steady profile, and walkers count as -1 where the start lies below it.
class WalkerStart {
 public:
  WalkerStart(const Job&, const InitialState&, const CellBox&);
  /// One place in cells (0 <= x < cells), independent of all others. [spacings]
  [[nodiscard]] Vec3 draw(Random&) const;
  /// +1 or -1, of a walker that starts here [cells].
  [[nodiscard]] int sign(const Vec3& cells) const { return excess_at(cells) < 0.0 ? -1 : 1; }
  [[nodiscard]] double base(const Vec3& cells) const;  ///< [K], at a place in cells
  /// Integral of |T - base| [K spacings^3]
  [[nodiscard]] double content() const { return cumulative_.back(); }
  /// Cell of each particle; -1 for one whose temperature is held.
  [[nodiscard]] const std::vector<int>& cell_of_particle() const { return cell_of_particle_; }
  /// The one axis that the start depends on, or whose faces are held; -1 where there are more, or none.
  [[nodiscard]] int only_axis() const;

 private:
  void place_particles(const InitialState&);
  void weigh_cells();
  /// T - base at a place within the particle's cell
  [[nodiscard]] double excess(int particle, const Vec3& cells) const;
  [[nodiscard]] double excess_at(const Vec3& cells) const;

  const Scene& scene_;
  const InitialState& state_;
  CellBox box_;
  double baseline_ = 0.0, top_ = 0.0;
  std::vector<int> cell_of_particle_, particle_of_cell_;
  /// Of the cells, x fastest: mean of T - base, and the sums of the mean sizes
  std::vector<double> mean_, cumulative_;
};

}  // namespace tripoint::lammps
