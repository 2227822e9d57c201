// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "render/target.hpp"
#include "surface/implicit_surface.hpp"

namespace tripoint {

/// The surface phi = 0 of particles, met by rays without a mesh between.
class SurfaceTarget : public Target {
 public:
  /// @param colours of the particles: the surface has their mean, weighted as in (24)
  SurfaceTarget(std::span<const Vec3> centres, const SurfaceOptions& options, std::vector<Colour> colours)
      : surface_(centres, options), colours_(std::move(colours)) {}
  [[nodiscard]] std::unique_ptr<Gaze> gaze() const override;
  [[nodiscard]] Box bounds() const override { return surface_.bounds(); }

 private:
  ImplicitSurface surface_;
  std::vector<Colour> colours_;
};

/// Distance at which a ray first passes from outside of phi = 0 to inside, to 1e-5 ir; nothing where it does
/// not. Cells leave out places that no particle is near. Elsewhere a step is at most 0.7 of phi, and at least
/// 0.03 ir. A surface towards which phi falls no faster than by 1/0.7 a metre is then not stepped through.
/// Matter thinner than 0.03 ir along the ray may be missed. The crossing is then closed in by false position
/// between the two places of unlike sign.
[[nodiscard]] std::optional<double> first_crossing(const ImplicitSurface&, SurfaceProbe&, const Ray&,
                                                   const Span&);

}  // namespace tripoint
