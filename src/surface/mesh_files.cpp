// SPDX-License-Identifier: BSD-3-Clause
#include "surface/mesh_files.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "core/not_a_number.hpp"
#include "core/written_file.hpp"
#include "scene/initial_state.hpp"

namespace tripoint {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void save(const std::string& path, const std::string& bytes) {
  WrittenFile out(path);
  out.add(bytes);
  out.close();
}

}  // namespace

void write_ply(const std::string& path, const std::vector<SurfacePart>& parts) {
  std::size_t corners = 0, triangles = 0;
  for (const SurfacePart& p : parts) {
    corners += p.mesh.points.size();
    triangles += p.mesh.triangles.size();
  }
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment phi = 0 of particles; x y z in m, temperature in K; phase 0 "
      "liquid, 1 elastic, "
      "2 rigid\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\nproperty float "
      "temperature\nproperty int "
      "phase\nproperty int body\nproperty int part\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      std::endian::native == std::endian::little ? "little" : "big", corners, triangles);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const SurfacePart& p = parts[n];
    for (std::size_t i = 0; i < p.mesh.points.size(); ++i) {
      for (std::size_t a = 0; a < 3; ++a) append(bytes, p.mesh.points[i][a]);
      append(bytes, static_cast<float>(p.temperature.empty() ? not_a_number : p.temperature[i]));
      append(bytes, static_cast<std::int32_t>(p.phase[i]));
      append(bytes, static_cast<std::int32_t>(p.body[i]));
      append(bytes, static_cast<std::int32_t>(n));
    }
  }
  std::uint32_t first = 0;
  for (const SurfacePart& p : parts) {
    for (const auto& t : p.mesh.triangles) {
      append(bytes, static_cast<std::uint8_t>(3));
      for (const std::uint32_t c : t) append(bytes, static_cast<std::int32_t>(first + c));
    }
    first += static_cast<std::uint32_t>(p.mesh.points.size());
  }
  save(path, bytes);
}

void write_obj(const std::string& path, const std::vector<SurfacePart>& parts) {
  std::string text = "# phi = 0 of particles, in m; an object for each body and liquid\n";
  std::uint32_t first = 1;  // OBJ counts from 1
  for (const SurfacePart& p : parts) {
    std::string name = p.name;
    for (char& c : name)
      if (c == ' ') c = '_';
    text += fmt::format("o {}\n", name);
    for (const Vec3& r : p.mesh.points) text += fmt::format("v {} {} {}\n", r.x, r.y, r.z);
    for (const auto& t : p.mesh.triangles)
      text += fmt::format("f {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    first += static_cast<std::uint32_t>(p.mesh.points.size());
  }
  save(path, text);
}

}  // namespace tripoint
