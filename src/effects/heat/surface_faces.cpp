// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/surface_faces.hpp"

#include <algorithm>
#include <Eigen/Dense>

namespace tripoint::heat {
namespace {

/// Faces that meet at less than 45 degrees count as one that is curved [1]. A choice.
constexpr double one_face = 0.707;
/// Slope of the distance on a plane face is 1, and at an edge less [1]. A choice.
constexpr double clean_slope = 0.9;

/// Gradient of the distance from a surface, by differences [1].
Vec3 gradient_at(const PlaceFunction& distance, const Vec3& r, double spacing) {
  const double step =
      0.05 * spacing;  // a choice: fields of meshes are linear between points half a spacing apart
  Vec3 n;
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 e;
    e[a] = step;
    n[a] = (distance(r + e) - distance(r - e)) / (2.0 * step);
  }
  return n;
}

bool is_another(const Vec3& n, const std::vector<Face>& known) {
  return std::ranges::none_of(known, [&](const Face& f) { return dot(n, f.normal) > one_face; });
}

/// Normal of the face that a way passes: at an edge that of one of its faces, which is none of `known`.
Vec3 normal_of_face(const PlaceFunction& distance, const Vec3& exit, double spacing,
                    const std::vector<Face>& known) {
  const auto slope = [&](const Vec3& r) { return gradient_at(distance, r, spacing); };
  const Vec3 raw = slope(exit);
  if (norm(raw) > clean_slope) return raw / norm(raw);
  for (std::size_t a = 0; a < 3; ++a)
    for (const double aside : {0.2 * spacing, -0.2 * spacing}) {
      Vec3 r = exit;
      r[a] += aside;
      const Vec3 n = slope(r);
      if (norm(n) > clean_slope && is_another(n / norm(n), known)) return n / norm(n);
    }
  return norm(raw) > 0.0 ? raw / norm(raw) : raw;
}

}  // namespace

double way_within(const Inside& inside, const Vec3& from, const Vec3& away) {
  double in = 0.0, out = 1.0;
  for (int n = 0; n < 30; ++n) {
    const double middle = 0.5 * (in + out);
    (inside(from + middle * away) ? in : out) = middle;
  }
  return 0.5 * (in + out);
}

Vec3 normal_at(const PlaceFunction& distance, const Vec3& r, double spacing) {
  const Vec3 n = gradient_at(distance, r, spacing);
  return norm(n) > 0.0 ? n / norm(n) : n;
}

std::vector<Face> faces_between(const Inside& inside, const PlaceFunction& distance, const Vec3& at,
                                const Vec3& away, double spacing) {
  std::vector<Face> faces;
  std::vector<Vec3> across;  // an orthogonal frame of the normals
  Vec3 way = away;
  while (faces.size() < 3 && !inside(at + way)) {
    const Vec3 to = way_within(inside, at, way) * way;
    const Vec3 n = normal_of_face(distance, at + to, spacing, faces);
    if (!is_another(n, faces)) break;
    faces.push_back({at + to, n, std::max(dot(n, to), least_way * spacing)});
    Vec3 own = n;
    for (const Vec3& e : across) own = own - dot(own, e) * e;
    across.push_back(own / norm(own));
    way = way - dot(way, across.back()) * across.back();
  }
  return faces;
}

std::vector<double> ways_across(const std::vector<Face>& faces, const Vec3& away) {
  const auto count = static_cast<Eigen::Index>(faces.size());
  Eigen::MatrixXd normals(count, 3);
  for (Eigen::Index f = 0; f < count; ++f)
    for (Eigen::Index a = 0; a < 3; ++a)
      normals(f, a) = faces[static_cast<std::size_t>(f)].normal[static_cast<std::size_t>(a)];
  const Eigen::VectorXd s =
      (normals * normals.transpose()).ldlt().solve(normals * Eigen::Vector3d(away.x, away.y, away.z));
  return {s.begin(), s.end()};
}

}  // namespace tripoint::heat
