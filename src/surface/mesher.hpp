// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

/// Triangles where a field on a sparse grid changes its sign, by OpenVDB. A module of its own, as
/// mesh/mesh_field.hpp is: with OpenVDB come 40 libraries, which every start of every program would wait for.
/// C names, and no exception leaves it.
extern "C" {
/// Points of a block along each axis: a leaf of OpenVDB's tree
inline constexpr int tripoint_mesher_block = 8;

/// Points [grid units], x y z of each, and triangles, three indices each, counter-clockwise seen from where
/// the field is positive.
struct TripointTriangles {
  double* points;
  std::size_t point_count;
  std::uint32_t* triangles;
  std::size_t triangle_count;
};

/// @param corners of the blocks, three multiples of 8 each   @param values 512 a block, z fastest, then y,
/// then x
/// @param outside value of all points that no block holds, positive
/// @return null where memory or OpenVDB failed
TripointTriangles* tripoint_mesher_make(const std::int32_t* corners, const float* values, std::size_t blocks,
                                        float outside);
void tripoint_mesher_free(TripointTriangles*);
}
