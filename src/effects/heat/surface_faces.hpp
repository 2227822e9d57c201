// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

#include "sampling/shape_distance.hpp"

/// Which faces of a body lie between a particle in it and a place beyond, for heat that passes them
/// (model 8.6).
namespace tripoint::heat {

using Inside = std::function<bool(const Vec3&)>;

/// Least share, within the body, of the way to a place beyond the surface [1]. Jitter may have put the
/// particle outside the shape, where the share would be 0. A choice, small beside a quarter of a spacing.
inline constexpr double least_way = 1e-3;

/// Share of the way from a point in the shape to one outside at which it leaves the shape, by halving: to a
/// billionth.
[[nodiscard]] double way_within(const Inside& inside, const Vec3& from, const Vec3& away);

/// Normal of the surface of a shape [1].
[[nodiscard]] Vec3 normal_at(const PlaceFunction& distance, const Vec3&, double spacing);

/// A face of the surface between a particle and a place beyond.
struct Face {
  Vec3 exit;     ///< where a way passes it [m]
  Vec3 normal;   ///< outwards [1]
  double depth;  ///< of the particle below it [m]
};

/// Faces between a particle and a place beyond: one, and at an edge or a corner two or three. The second is
/// that through which the way leaves that goes along the first.
[[nodiscard]] std::vector<Face> faces_between(const Inside&, const PlaceFunction& distance, const Vec3& at,
                                              const Vec3& away, double spacing);

/// Shares s of the faces [m]: where q_f flows in through face f, the temperature of the place is that of the
/// particle + sum s_f q_f/k, in the linear field that has k n_f . grad T = q_f at each.
[[nodiscard]] std::vector<double> ways_across(const std::vector<Face>&, const Vec3& away);

}  // namespace tripoint::heat
