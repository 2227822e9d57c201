// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <span>

#include "core/vec3.hpp"
#include "surface/cell_table.hpp"
#include "surface/detector.hpp"
#include "surface/point_cells.hpp"

namespace tripoint {

/// Lengths and switches of (22) to (26).
struct SurfaceOptions {
  double influence_radius = 0.0;  ///< ir of (24), smoothness of the surface [m]
  double distance = 0.0;          ///< R of (22), (23), of the surface from the particles [m]
  bool detector = true;           ///< false: f = 1, the surface of [Zhu & Bridson 2005], (22)
  DetectorLimits limits;

  /// Values used where nobody says otherwise: the paper gives neither length (docs/surface.md says why
  /// these).
  /// @param spacing of the particles [m]
  [[nodiscard]] static SurfaceOptions for_spacing(double spacing) noexcept {
    SurfaceOptions o;
    o.influence_radius = 2.4 * spacing;
    o.distance = distance_per_influence_radius * o.influence_radius;
    return o;
  }
  /// R/ir at which a flat surface lies half a layer outside the last layer of a cubic lattice. At an ir
  /// of 2.4 spacings it is 0.284, 0.273, 0.267 on its planes (100), (110), (111), and 0.2598 in the
  /// continuum. The value is a little more, because balls of ten spacings then have their volume best.
  static constexpr double distance_per_influence_radius = 0.28;
};

/// Parts of the surface function at one place.
struct SurfaceValue {
  double phi = 0.0;         ///< (23), below zero inside [m]
  double eigenvalue = 0.0;  ///< EV_max [1]; 0 where the detector is off or no particle is near
  double factor = 1.0;      ///< f [1]
  bool near = false;        ///< whether a particle is within ir: else phi is ir, and nothing else is known
};

/// The surface phi = 0 of a set of particles, (22) to (26): of a body, of a liquid, or of all of them.
class ImplicitSurface {
 public:
  /// @param centres of the particles, finite [m]; copied
  /// @throws InputError where a length is not positive, or the particles lie too far apart (PointCells)
  ImplicitSurface(std::span<const Vec3> centres, const SurfaceOptions&);

  [[nodiscard]] const SurfaceOptions& options() const noexcept { return options_; }
  [[nodiscard]] const PointCells& cells() const noexcept { return cells_; }
  /// Outside of it no particle is within ir [m].
  [[nodiscard]] Box bounds() const noexcept { return grown(cells_.box(), options_.influence_radius); }
  /// A box around a place in which no place is within ir of a particle; nothing where there is none such.
  [[nodiscard]] std::optional<Box> empty_box(const Vec3&) const noexcept;
  /// Ascending keys of the cubic cells of side ir that may hold a place within ir of a particle. They are
  /// counted from the lower corner of bounds().
  [[nodiscard]] std::span<const std::uint64_t> near_cells() const noexcept { return near_keys_; }

 private:
  SurfaceOptions options_;
  PointCells cells_;  // of half of ir
  Vec3 origin_;       // of the near cells
  CellTable near_;
  std::vector<std::uint64_t> near_keys_;
};

/// One thread's view of a surface: keeps the lists of the places that it was asked about last. The values do
/// not depend on earlier calls.
class SurfaceProbe {
 public:
  /// @param surface must outlive it
  explicit SurfaceProbe(const ImplicitSurface& surface)
      : surface_(&surface), cache_(surface.cells(), surface.options().influence_radius) {}

  [[nodiscard]] SurfaceValue value(const Vec3& r);
  /// (23) [m]
  [[nodiscard]] double phi(const Vec3& r) { return value(r).phi; }
  /// grad phi [1] by central differences over a fiftieth of ir: its own formula would need the second
  /// derivatives of rbar.
  [[nodiscard]] Vec3 gradient(const Vec3& r);
  /// Distance to the nearest particle [m]; nothing where none is within ir of the place's cell.
  [[nodiscard]] std::optional<double> nearest(const Vec3& r);
  /// Calls visit(row, weight) for each particle within ir of r, in a fixed order; weight as in (24).
  template <class Visit>
  void weigh(const Vec3& r, Visit&& visit);

 private:
  const ImplicitSurface* surface_;
  NearCache cache_;
};

template <class Visit>
void SurfaceProbe::weigh(const Vec3& r, Visit&& visit) {
  const double ir = surface_->options().influence_radius;
  const NearPoints& near = cache_.around(r);
  for (std::size_t k = 0; k < near.row.size(); ++k) {
    const Vec3 d{near.x[k] - r.x, near.y[k] - r.y, near.z[k] - r.z};
    const double t = 1.0 - dot(d, d) / (ir * ir);
    if (t > 0.0) visit(near.row[k], t * t * t);
  }
}

}  // namespace tripoint
