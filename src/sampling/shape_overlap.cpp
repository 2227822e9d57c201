// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/shape_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sampling/shape_distance.hpp"
#include "scene/geometry.hpp"

namespace tripoint {
namespace {

// Of each body of a pair: space that is shared along a face is found from far fewer
constexpr std::size_t most_starts = 5000;

bool has_mesh(const Shape& s) {
  return s.kind == Shape::Kind::mesh ||
         std::ranges::any_of(s.of, [](const Shape& part) { return has_mesh(part); });
}

/// A body's shape with its images in periodic directions.
class Extent {
 public:
  Extent(const Scene& s, const Body& b)
      : spacing_(s.spacing),
        distance_(distance_of(b.shape, s.spacing)),
        bounds_(bounds(b.shape)),
        is_mesh(has_mesh(b.shape)) {
    for (std::size_t a = 0; a < 3; ++a) {
      bounds_.min[a] -= spacing_;
      bounds_.max[a] += spacing_;
      width_[a] = s.periodic[a] ? (*s.max)[a] - (*s.min)[a] : 0.0;
    }
  }
  /// False where the bounds are apart; periodic images may meet anywhere.
  [[nodiscard]] bool may_meet(const Extent& other) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (!(width_[a] > 0.0) &&
          (bounds_.max[a] < other.bounds_.min[a] || other.bounds_.max[a] < bounds_.min[a]))
        return false;
    return true;
  }
  /// Signed distance to the nearest image; a spacing where the place is farther from all of them.
  [[nodiscard]] double operator()(const Vec3& r) const {
    double least = spacing_;
    const auto shifts = [&](std::size_t a) { return width_[a] > 0.0 ? 1 : 0; };
    for (int i = -shifts(0); i <= shifts(0); ++i)
      for (int j = -shifts(1); j <= shifts(1); ++j)
        for (int k = -shifts(2); k <= shifts(2); ++k) {
          const Vec3 image = r + Vec3{i * width_.x, j * width_.y, k * width_.z};
          if (reaches(image)) least = std::min(least, distance_(image));
        }
    return least;
  }

 private:
  [[nodiscard]] bool reaches(const Vec3& r) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (r[a] < bounds_.min[a] || r[a] > bounds_.max[a]) return false;
    return true;
  }
  double spacing_;
  PlaceFunction distance_;
  Bounds bounds_;
  Vec3 width_;

 public:
  bool is_mesh;  ///< or made of one
};

/// Steps to the 26 neighbours of a cell.
std::vector<Vec3> directions() {
  std::vector<Vec3> list;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (i != 0 || j != 0 || k != 0) list.push_back({double(i), double(j), double(k)});
  return list;
}

/// Goes from a place to where the nearer of both surfaces is deepest: steps that are halved where none of
/// them helps.
double deepest(const Extent& a, const Extent& b, Vec3& place, double spacing, double last_step) {
  static const auto ways = directions();
  const auto depth = [&](const Vec3& r) { return -std::max(a(r), b(r)); };
  double best = depth(place);
  for (double step = 0.5 * spacing; step > last_step;) {
    Vec3 next = place;
    for (const auto& way : ways) {
      const Vec3 r = place + step * way;
      if (const double d = depth(r); d > best + 1e-9 * spacing) {
        best = d;
        next = r;
      }
    }
    if (next == place)
      step *= 0.5;
    else
      place = next;
    if (best > spacing) break;  // more than enough is known
  }
  return best;
}

/// Particles of one body that are within a spacing of the other one's shape, thinned out.
std::vector<Vec3> starts(const std::vector<Vec3>& particles, const Extent& other, double spacing) {
  std::vector<Vec3> near;
  for (const auto& r : particles)
    if (other(r) < 0.95 * spacing) near.push_back(r);
  if (near.size() <= most_starts) return near;
  std::vector<Vec3> some;
  for (std::size_t n = 0; n < most_starts; ++n) some.push_back(near[n * near.size() / most_starts]);
  return some;
}

}  // namespace

std::vector<SharedSpace> shared_spaces(const Scene& s, const InitialState& state, double fineness) {
  if (s.bodies.size() < 2) return {};
  std::vector<Extent> extents;
  for (const auto& b : s.bodies) extents.emplace_back(s, b);
  std::vector<std::vector<Vec3>> particles(s.bodies.size());
  for (std::size_t i = 0; i < state.size(); ++i)
    particles[static_cast<std::size_t>(state.source[i])].push_back(state.position[i]);
  std::vector<SharedSpace> found;
  for (std::size_t a = 0; a < extents.size(); ++a)
    for (std::size_t b = a + 1; b < extents.size(); ++b) {
      if (!extents[a].may_meet(extents[b])) continue;
      const double thin = (extents[a].is_mesh || extents[b].is_mesh ? 0.25 : 0.02) * fineness * s.spacing;
      SharedSpace shared{a, b, 0.0, {}};
      for (const auto& list :
           {starts(particles[a], extents[b], s.spacing), starts(particles[b], extents[a], s.spacing)})
        for (Vec3 place : list)
          if (const double d =
                  2.0 * deepest(extents[a], extents[b], place, s.spacing, fineness * s.spacing / 200.0);
              d > shared.thickness) {
            shared.thickness = d;
            shared.place = place;
          }
      if (shared.thickness > thin) found.push_back(shared);
    }
  return found;
}

}  // namespace tripoint
