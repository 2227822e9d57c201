// SPDX-License-Identifier: BSD-3-Clause
// OpenVDB, whose headers take long to compile, in this file and mesh/mesh_field.cpp alone.
#include "surface/mesher.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <vector>

namespace {

using Points = std::vector<openvdb::Vec3s>;

double distance2(const Points& p, std::uint32_t a, std::uint32_t b) { return (p[a] - p[b]).lengthSqr(); }

/// A quad is cut along its shorter diagonal.
void append_quad(const Points& points, const openvdb::Vec4I& q,
                 std::vector<std::array<std::uint32_t, 3>>& out) {
  if (distance2(points, q[0], q[2]) <= distance2(points, q[1], q[3])) {
    out.push_back({q[0], q[1], q[2]});
    out.push_back({q[0], q[2], q[3]});
  } else {
    out.push_back({q[0], q[1], q[3]});
    out.push_back({q[1], q[2], q[3]});
  }
}

}  // namespace

TripointTriangles* tripoint_mesher_make(const std::int32_t* corners, const float* values, std::size_t blocks,
                                        float outside) {
  try {
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(outside);
    constexpr std::size_t size =
        std::size_t{tripoint_mesher_block} * tripoint_mesher_block * tripoint_mesher_block;
    for (std::size_t b = 0; b < blocks; ++b) {
      auto* leaf = grid->tree().touchLeaf({corners[3 * b], corners[3 * b + 1], corners[3 * b + 2]});
      std::copy_n(values + b * size, size, leaf->buffer().data());
      leaf->setValuesOn();
    }
    Points points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, 0.0);
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (const auto& t : triangles) faces.push_back({t[0], t[1], t[2]});
    for (const auto& q : quads) append_quad(points, q, faces);
    auto made =
        std::make_unique<TripointTriangles>(TripointTriangles{nullptr, points.size(), nullptr, faces.size()});
    auto places = std::make_unique<double[]>(3 * points.size() + 1);
    auto corners_of = std::make_unique<std::uint32_t[]>(3 * faces.size() + 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int a = 0; a < 3; ++a)
        places[3 * i + static_cast<std::size_t>(a)] = static_cast<double>(points[i][a]);
    for (std::size_t i = 0; i < faces.size(); ++i)
      std::copy(faces[i].begin(), faces[i].end(), corners_of.get() + 3 * i);
    made->points = places.release();
    made->triangles = corners_of.release();
    return made.release();
  } catch (const std::exception&) {
    return nullptr;
  }
}

void tripoint_mesher_free(TripointTriangles* made) {
  if (made == nullptr) return;
  delete[] made->points;
  delete[] made->triangles;
  delete made;
}
