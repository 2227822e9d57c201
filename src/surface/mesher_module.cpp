// SPDX-License-Identifier: BSD-3-Clause
#include "surface/mesher_module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>

#include "core/errors.hpp"
#include "tables/library.hpp"

namespace tripoint {
namespace {

/// lib/tripoint/surface-mesher.so beside share/tripoint.
struct Module {
  decltype(&tripoint_mesher_make) make = nullptr;
  decltype(&tripoint_mesher_free) free = nullptr;
  std::string failure;  ///< why it could not be loaded

  Module() {
    const auto root = std::filesystem::path(share_folder()).parent_path().parent_path();
    void* library = dlopen((root / "lib" / "tripoint" / "surface-mesher.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      failure = dlerror();
      return;
    }
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr) failure = std::string("it has no function ") + name;
    };
    find(make, "tripoint_mesher_make");
    find(free, "tripoint_mesher_free");
  }
};

}  // namespace

Mesh sign_changes(const std::vector<std::int32_t>& corners, const std::vector<float>& values, float outside) {
  static const Module loaded;
  if (!loaded.failure.empty())
    throw EngineError("the part of the program that makes meshes cannot be loaded: " + loaded.failure);
  const std::unique_ptr<TripointTriangles, decltype(loaded.free)> made(
      loaded.make(corners.data(), values.data(), corners.size() / 3, outside), loaded.free);
  if (!made) throw EngineError("OpenVDB made no mesh of the surface (not enough memory?)");
  Mesh mesh;
  mesh.points.reserve(made->point_count);
  mesh.triangles.reserve(made->triangle_count);
  for (std::size_t i = 0; i < made->point_count; ++i)
    mesh.points.push_back({made->points[3 * i], made->points[3 * i + 1], made->points[3 * i + 2]});
  for (std::size_t i = 0; i < made->triangle_count; ++i)
    mesh.triangles.push_back(
        {made->triangles[3 * i], made->triangles[3 * i + 1], made->triangles[3 * i + 2]});
  return mesh;
}

}  // namespace tripoint
