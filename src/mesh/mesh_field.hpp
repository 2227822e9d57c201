// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

/// Signed distance to a closed mesh, made by OpenVDB. It is a module of its own, loaded when the first mesh
/// is met. With OpenVDB come 40 libraries, and every start of every program would wait for them. C names, and
/// no exception leaves it.
extern "C" {
struct TripointMeshField;

/// @param points [m], x y z of each; triangles: three indices each; voxel [m]
/// @return null where memory or OpenVDB failed
TripointMeshField* tripoint_mesh_field_make(const double* points, std::size_t point_count,
                                            const std::uint32_t* triangles, std::size_t triangle_count,
                                            double voxel);
void tripoint_mesh_field_free(TripointMeshField*);
/// Least distance that the field holds, below zero inside [m].
double tripoint_mesh_field_deepest(const TripointMeshField*);
/// Distance at a place, below zero inside [m].
double tripoint_mesh_field_at(const TripointMeshField*, double x, double y, double z);
}
