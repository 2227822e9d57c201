// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "render/target.hpp"

namespace tripoint {

/// Particles as balls of one size.
class SphereTarget : public Target {
 public:
  /// @param radius of each ball [m]   @param colours of the particles
  SphereTarget(std::span<const Vec3> centres, double radius, std::vector<Colour> colours)
      : cells_(centres, 2.0 * radius), radius_(radius), colours_(std::move(colours)) {}
  [[nodiscard]] std::unique_ptr<Gaze> gaze() const override;
  [[nodiscard]] Box bounds() const override { return grown(cells_.box(), radius_); }

 private:
  PointCells cells_;
  double radius_;
  std::vector<Colour> colours_;
};

}  // namespace tripoint
