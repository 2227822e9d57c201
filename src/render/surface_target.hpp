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

/// Distance at which a ray first passes from outside of phi = 0 to inside, to 1e-5 ir; nothing where it does not.
/// Places that no particle is near are left out by cells; elsewhere a step is at most 0.7 of phi, so that a surface towards which
/// phi falls no faster than by 1/0.7 a metre is not stepped through, and at least 0.03 ir: what is thinner along the ray may be
/// missed. The crossing is then closed in by false position between the two places of unlike sign.
[[nodiscard]] std::optional<double> first_crossing(const ImplicitSurface&, SurfaceProbe&, const Ray&, const Span&);

}  // namespace tripoint
