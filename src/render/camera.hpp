// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "core/vec3.hpp"
#include "surface/point_cells.hpp"

namespace tripoint {

/// a / |a|. @param a not 0
inline Vec3 unit_vector(const Vec3& a) noexcept { return a / norm(a); }

/// A half line. @param along a unit vector
struct Ray {
  Vec3 from, along;
  [[nodiscard]] Vec3 at(double t) const noexcept { return from + t * along; }
};

/// Where from a picture is taken.
struct View {
  double azimuth = 30.0;    ///< to the right of the front, which looks along +y [degrees]
  double elevation = 20.0;  ///< above the horizon [degrees]
};

/// Unit vectors of a picture: into it, to the right, upwards.
struct CameraAxes {
  Vec3 forward, right, upward;
  /// @param up unit vector against gravity: it shows upwards in the picture
  CameraAxes(const Vec3& up, const View&) noexcept;
};

/// A camera without lens errors.
class Camera {
 public:
  /// Stands as near as it can with all these places in the picture.
  /// @param room around each place [m]   @param aspect width over height of the picture
  Camera(std::span<const Vec3> places, double room, const CameraAxes&, double aspect) noexcept;
  /// @param x, y -1 to 1, to the right and upwards
  [[nodiscard]] Ray ray(double x, double y) const noexcept;
  [[nodiscard]] const Vec3& eye() const noexcept { return eye_; }
  /// Unit vector out of the picture, towards the viewer.
  [[nodiscard]] Vec3 towards() const noexcept { return -axes_.forward; }
  [[nodiscard]] const CameraAxes& axes() const noexcept { return axes_; }

 private:
  CameraAxes axes_;
  double half_width_, half_height_;  // of the picture at distance 1
  Vec3 eye_;
};

/// Distances between which a ray is inside a box; from above to where it misses.
struct Span {
  double from, to;
  [[nodiscard]] bool empty() const noexcept { return !(from < to); }
};
[[nodiscard]] Span inside(const Ray&, const Box&) noexcept;

/// Unit vector against gravity; +z where there is none.
[[nodiscard]] Vec3 upwards(const Vec3& gravity) noexcept;

}  // namespace tripoint
