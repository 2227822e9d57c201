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

/// Temperature above a baseline as a density to draw walkers from: T(r) = baseline + (content / N) n(r), n the number density.
class WalkerStart {
 public:
  WalkerStart(const Job&, const InitialState&, const CellBox&);
  /// One place in cells (0 <= x < cells), independent of all others. [spacings]
  [[nodiscard]] Vec3 draw(Random&) const;
  [[nodiscard]] double baseline() const { return baseline_; }  ///< the field's least value [K]
  [[nodiscard]] double content() const { return cumulative_.back(); }  ///< integral of T - baseline [K spacings^3]
  /// Cell of each particle.
  [[nodiscard]] const std::vector<int>& cell_of_particle() const { return cell_of_particle_; }
  /// The one axis that the start depends on; -1 where it depends on more, or on none.
  [[nodiscard]] int only_axis() const;

 private:
  void place_particles(const InitialState&);
  void weigh_cells();
  [[nodiscard]] double excess(int particle, const Vec3& cells) const;  ///< T - baseline at a place within the particle's cell

  const Scene& scene_;
  const InitialState& state_;
  CellBox box_;
  double baseline_ = 0.0, top_ = 0.0;
  std::vector<int> cell_of_particle_, particle_of_cell_;
  std::vector<double> weight_, cumulative_;  ///< of the cells, x fastest
};

}  // namespace tripoint::lammps
