// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "particles/pair_lists.hpp"
#include "scene/scene.hpp"
#include "scene/shared_terms.hpp"

/// When a bond breaks: formulas of one bond.
namespace tripoint::fracture {

/// Corrected: by stretch |r|/|x|, the same for short and long bonds.
[[nodiscard]] constexpr bool breaks_by_stretch(const Vec3& r, const Vec3& x, double stretch) noexcept {
  return dot(r, r) > stretch * stretch * dot(x, x);
}
/// As printed: by distance |r| [m]. Its fault: a body's long bonds break first, at a stretch that short ones
/// bear.
[[nodiscard]] constexpr bool breaks_by_distance(const Vec3& r, double distance) noexcept {
  return dot(r, r) > distance * distance;
}

/// The limits of a scene's materials in the form of its elasticity: `fracture_stretch`, printed
/// `fracture_distance`. Where two materials meet the lower limit holds.
class BondLimits {
 public:
  explicit BondLimits(const Scene& scene) : paper_(scene.mode_of(term::elastic) == Mode::paper) {
    constexpr double never = std::numeric_limits<double>::infinity();
    for (const Material& m : scene.materials) {
      const std::optional<double>& given = paper_ ? m.fracture_distance : m.fracture_stretch;
      limit_.push_back(given ? (paper_ ? scene.spacing : 1.0) * *given : never);
    }
  }
  /// @param r r_i - r_j [m]   @param a,b materials of the two
  [[nodiscard]] bool breaks(const Vec3& r, const Bond& bond, std::size_t a, std::size_t b) const {
    const double limit = limit_of(a, b);
    return paper_ ? breaks_by_distance(r, limit) : breaks_by_stretch(r, bond.x, limit);
  }
  /// By how much |r| may grow before the bond breaks [m].
  [[nodiscard]] double headroom(const Vec3& r, const Bond& bond, std::size_t a, std::size_t b) const {
    return (paper_ ? 1.0 : norm(bond.x)) * limit_of(a, b) - norm(r);
  }

 private:
  [[nodiscard]] double limit_of(std::size_t a, std::size_t b) const { return std::min(limit_[a], limit_[b]); }

  bool paper_;
  std::vector<double> limit_;  ///< of each material: [1], printed [m]
};

}  // namespace tripoint::fracture
