// SPDX-License-Identifier: BSD-3-Clause
#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tripoint {
namespace {

constexpr double half_angle = 15.0;  // of the picture's height [degrees]
constexpr double margin = 1.06;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

}  // namespace

CameraAxes::CameraAxes(const Vec3& up, const View& view) noexcept {
  const Vec3 y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
  const Vec3 ahead =
      std::abs(up.y) < 0.9 ? unit_vector(y - dot(y, up) * up) : unit_vector(z - dot(z, up) * up);
  const Vec3 aside = cross(ahead, up);
  const double az = radians(view.azimuth), el = radians(std::clamp(view.elevation, -89.0, 89.0));
  forward = std::cos(el) * (std::cos(az) * ahead - std::sin(az) * aside) - std::sin(el) * up;
  right = unit_vector(cross(forward, up));
  upward = cross(right, forward);
}

// The eye is at (X, Y, E), a place at (x, y) across and f along the axes. The place is in the picture where
// |x - X| <= w (f - E) and |y - Y| <= h (f - E). Each side of the picture bounds one sum of two coordinates,
// and the greatest of all places counts.
Camera::Camera(std::span<const Vec3> places, double room, const CameraAxes& axes, double aspect) noexcept
    : axes_(axes),
      half_width_(aspect * std::tan(radians(half_angle))),
      half_height_(std::tan(radians(half_angle))) {
  const double w = half_width_ / margin, h = half_height_ / margin,
               most = std::numeric_limits<double>::infinity();
  double right = -most, left = -most, top = -most, bottom = -most;
  for (const Vec3& r : places) {
    const double x = dot(r, axes.right), y = dot(r, axes.upward), f = dot(r, axes.forward) - room;
    right = std::max(right, x + room - w * f);
    left = std::max(left, -x + room - w * f);
    top = std::max(top, y + room - h * f);
    bottom = std::max(bottom, -y + room - h * f);
  }
  if (places.empty()) right = left = top = bottom = 1.0;
  const double along = std::min(-(right + left) / (2.0 * w), -(top + bottom) / (2.0 * h));
  eye_ = along * axes.forward + 0.5 * (right - left) * axes.right + 0.5 * (top - bottom) * axes.upward;
}

Ray Camera::ray(double x, double y) const noexcept {
  return {eye_, unit_vector(axes_.forward + x * half_width_ * axes_.right + y * half_height_ * axes_.upward)};
}

Span inside(const Ray& ray, const Box& box) noexcept {
  Span s{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (std::size_t a = 0; a < 3; ++a) {
    if (ray.along[a] == 0.0) {
      if (ray.from[a] < box.low[a] || ray.from[a] > box.high[a]) return {1.0, 0.0};
      continue;
    }
    double near = (box.low[a] - ray.from[a]) / ray.along[a], far = (box.high[a] - ray.from[a]) / ray.along[a];
    if (near > far) std::swap(near, far);
    s.from = std::max(s.from, near);
    s.to = std::min(s.to, far);
  }
  return s;
}

Vec3 upwards(const Vec3& gravity) noexcept {
  const double g = norm(gravity);
  return g > 0.0 ? -gravity / g : Vec3{0.0, 0.0, 1.0};
}

}  // namespace tripoint
