// SPDX-License-Identifier: BSD-3-Clause
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "core/errors.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_field.hpp"
#include "tables/library.hpp"

namespace tripoint {
namespace {

/// The module that holds OpenVDB, found as lib/tripoint beside share/tripoint.
struct Module {
  decltype(&tripoint_mesh_field_make) make = nullptr;
  decltype(&tripoint_mesh_field_free) free = nullptr;
  decltype(&tripoint_mesh_field_deepest) deepest = nullptr;
  decltype(&tripoint_mesh_field_at) at = nullptr;
  std::string failure;  ///< why it could not be loaded

  Module() {
    const auto root = std::filesystem::path(share_folder()).parent_path().parent_path();
    void* library = dlopen((root / "lib" / "tripoint" / "mesh-field.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      failure = dlerror();
      return;
    }
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr) failure = fmt::format("it has no function {}", name);
    };
    find(make, "tripoint_mesh_field_make");
    find(free, "tripoint_mesh_field_free");
    find(deepest, "tripoint_mesh_field_deepest");
    find(at, "tripoint_mesh_field_at");
  }
};

const Module& module() {
  static const Module loaded;
  return loaded;
}

}  // namespace

struct MeshInterior::Grid {
  TripointMeshField* field = nullptr;
  explicit Grid(TripointMeshField* f) : field(f) {}
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;
  ~Grid() { module().free(field); }
};

MeshInterior::MeshInterior(const Mesh& mesh, double voxel, const std::string& file) {
  const Module& vdb = module();
  if (!vdb.failure.empty())
    throw InputError(
        {file, 0, 0},
        fmt::format("the part of the program that reads meshes cannot be loaded: {}", vdb.failure));
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  points.reserve(3 * mesh.points.size());
  triangles.reserve(3 * mesh.triangles.size());
  for (const auto& p : mesh.points) points.insert(points.end(), {p.x, p.y, p.z});
  for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  TripointMeshField* field =
      vdb.make(points.data(), mesh.points.size(), triangles.data(), mesh.triangles.size(), voxel);
  if (field == nullptr)
    throw InputError({file, 0, 0}, fmt::format("no distance field of the mesh at voxels of {} m", voxel));
  grid_ = std::make_unique<Grid>(field);
  // A leaking mesh has no inside at all, silently: values below zero are round-off at its surface.
  if (!(vdb.deepest(field) < -1e-3 * voxel))
    throw InputError(
        {file, 0, 0},
        fmt::format(
            "the mesh has no inside at voxels of {} m: its surface leaks, or it is thinner than the spacing",
            voxel));
}

MeshInterior::~MeshInterior() = default;

double MeshInterior::distance(const Vec3& r) const { return module().at(grid_->field, r.x, r.y, r.z); }

}  // namespace tripoint
