// SPDX-License-Identifier: BSD-3-Clause
// OpenVDB, whose headers take long to compile, in this file alone.
#include "mesh/mesh_field.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <exception>
#include <vector>

struct TripointMeshField {
  openvdb::FloatGrid::Ptr field;
  openvdb::FloatGrid::ConstAccessor values;
  explicit TripointMeshField(openvdb::FloatGrid::Ptr f)
      : field(std::move(f)), values(field->getConstAccessor()) {}
};

TripointMeshField* tripoint_mesh_field_make(const double* points, std::size_t point_count,
                                            const std::uint32_t* triangles, std::size_t triangle_count,
                                            double voxel) {
  try {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> corners;
    std::vector<openvdb::Vec3I> faces;
    corners.reserve(point_count);
    faces.reserve(triangle_count);
    for (std::size_t i = 0; i < 3 * point_count; i += 3)
      corners.emplace_back(static_cast<float>(points[i]), static_cast<float>(points[i + 1]),
                           static_cast<float>(points[i + 2]));
    for (std::size_t i = 0; i < 3 * triangle_count; i += 3)
      faces.emplace_back(triangles[i], triangles[i + 1], triangles[i + 2]);
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    return new TripointMeshField(openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
        *transform, corners, faces, std::vector<openvdb::Vec4I>{}, 3.0F));
  } catch (const std::exception&) {
    return nullptr;
  }
}

void tripoint_mesh_field_free(TripointMeshField* f) { delete f; }

double tripoint_mesh_field_deepest(const TripointMeshField* f) {
  float deepest = 0.0F;
  for (auto v = f->field->cbeginValueAll(); v; ++v) deepest = std::min(deepest, *v);
  return deepest;
}

double tripoint_mesh_field_at(const TripointMeshField* f, double x, double y, double z) {
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
      f->values, f->field->transform());
  return sampler.wsSample(openvdb::Vec3R(x, y, z));
}
