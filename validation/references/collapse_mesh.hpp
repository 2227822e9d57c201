// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace tripoint {

/// A column of liquid that stands against a wall on a floor, both without friction [m, m, m/s2].
struct LiquidColumn {
  double width = 0.0, height = 0.0, gravity = 0.0;
};

/// The collapse of a column in the plane, inviscid and incompressible, on a mesh that moves with the liquid.
/// Nodes are masses. The area of each cell is a constraint, whose multiplier is the cell's pressure. The
/// equations of such a system are those of Lagrange for positions under constraints. They are stepped by the
/// Verlet scheme, each step put back onto the constraints [Ryckaert, Ciccotti, Berendsen 1977]. Constant
/// areas leave each cell a motion that no pressure resists, which grows where cells are drawn out. A
/// viscosity that no linear motion feels damps it, and vanishes as the mesh is refined [Flanagan & Belytschko
/// 1981]. Lengths are counted in widths, times in sqrt(width/gravity).
class CollapseMesh {
 public:
  /// @param cells across the width; up the height as many as make them nearly square
  /// @param damping of the motion that no pressure resists, over sqrt(gravity height)/(width/cells)
  CollapseMesh(const LiquidColumn&, int cells, double damping = 1.0);
  ~CollapseMesh();

  /// One step of 0.05 cell widths over sqrt(gravity width).
  /// @throws InputError where the cells have become too distorted for the areas to be kept
  void step();
  [[nodiscard]] double time() const { return time_; }  ///< [s]
  [[nodiscard]] double step_size() const;              ///< [s]
  /// Where the surface meets the floor, from the wall [m]
  [[nodiscard]] double front() const;
  /// Where the surface meets the wall, from the floor [m]
  [[nodiscard]] double top() const;
  [[nodiscard]] double energy() const;               ///< kinetic and potential, over that of the start
  [[nodiscard]] double greatest_area_error() const;  ///< of all cells, over a cell's area
  [[nodiscard]] std::array<int, 2> cells() const;    ///< along the floor and up the wall
  /// Mean over the last step, over density gravity width; cells from the corner of wall and floor
  [[nodiscard]] double pressure(int i, int j) const;
  /// The same at a place, from wall and floor [m]: by a linear fit to the nearest cell and those around it.
  [[nodiscard]] double pressure_at(double x, double y) const;

 private:
  struct System;
  LiquidColumn column_;
  std::unique_ptr<System> system_;
  double time_ = 0.0;
};

/// Fronts over the floor at rising times, and by how much a mesh of half as many cells puts each elsewhere
/// [m].
struct CollapseFronts {
  std::vector<double> front, difference;
};
/// Pressure at a place, over density gravity width, and by how much a mesh of half as many cells puts each
/// elsewhere.
struct CollapsePressures {
  std::vector<double> pressure, difference;
};
/// At the steps next to rising times. @param x,y from wall and floor [m]
/// @throws InputError where the mesh does not last until the last time
[[nodiscard]] CollapsePressures collapse_pressures(const LiquidColumn&, int cells,
                                                   const std::vector<double>& times, double x, double y);
/// Between steps by straight lines. One computation for the same question within a process.
/// @throws InputError where the mesh does not last until the last time
[[nodiscard]] CollapseFronts collapse_fronts(const LiquidColumn&, int cells,
                                             const std::vector<double>& times);

}  // namespace tripoint
