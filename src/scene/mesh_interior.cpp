// SPDX-License-Identifier: BSD-3-Clause
// OpenVDB, whose headers take long to compile, in this file alone.
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>

#include "core/errors.hpp"
#include "scene/mesh.hpp"

namespace tripoint {

struct MeshInterior::Grid {
  openvdb::FloatGrid::Ptr field;
  openvdb::FloatGrid::ConstAccessor values;
  explicit Grid(openvdb::FloatGrid::Ptr f) : field(std::move(f)), values(field->getConstAccessor()) {}
};

MeshInterior::MeshInterior(const Mesh& mesh, double voxel, const std::string& file) {
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  points.reserve(mesh.points.size()), triangles.reserve(mesh.triangles.size());
  for (const auto& p : mesh.points) points.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  auto field = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles, std::vector<openvdb::Vec4I>{}, 3.0F);
  grid_ = std::make_unique<Grid>(std::move(field));
  // A leaking mesh has no inside at all, silently: what is left below zero is round-off at its surface.
  float deepest = 0.0F;
  for (auto v = grid_->field->cbeginValueAll(); v; ++v) deepest = std::min(deepest, *v);
  if (!(deepest < static_cast<float>(-1e-3 * voxel))) throw InputError({file, 0, 0}, fmt::format("the mesh has no inside at voxels of {} m: its surface leaks, or it is thinner than the spacing", voxel));
}

MeshInterior::~MeshInterior() = default;

bool MeshInterior::holds(const Vec3& r) const {
  const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(grid_->values, grid_->field->transform());
  return sampler.wsSample(openvdb::Vec3R(r.x, r.y, r.z)) <= 0.0F;
}

}  // namespace tripoint
