// SPDX-License-Identifier: BSD-3-Clause
#include "files/point_cloud.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/written_file.hpp"

namespace tripoint {
namespace {

std::string base64(std::span<const unsigned char> bytes) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b) three = three << 8 | (b < n ? bytes[k + b] : 0u);
    for (std::size_t c = 0; c < 4; ++c) text += c <= n ? letters[three >> (18 - 6 * c) & 63u] : '=';
  }
  return text;
}

/// The length in bytes, then the values, each encoded by itself: VTK's inline binary.
template <class T>
std::string encoded(const std::vector<T>& values) {
  const std::uint64_t length = values.size() * sizeof(T);
  std::vector<unsigned char> head(sizeof length), body(length);
  std::memcpy(head.data(), &length, sizeof length);
  if (length > 0) std::memcpy(body.data(), values.data(), length);
  head.insert(head.end(), body.begin(), body.end());
  return base64(head);
}

template <class T>
void array(WrittenFile& out, const char* type, const std::string& name, std::size_t components,
           const std::vector<T>& values) {
  out.add(fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n", type,
      name, components, encoded(values)));
}

}  // namespace

void write_vtp(const std::string& path, const PointCloud& cloud) {
  const std::size_t n = cloud.place.size();
  std::vector<double> places;
  std::vector<std::int64_t> points(n), ends(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < 3; ++a) places.push_back(cloud.place[i][a]);
    points[i] = static_cast<std::int64_t>(i);
    ends[i] = points[i] + 1;
  }
  WrittenFile out(path);
  out.add(
      fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" "
                  "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n",
                  std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian"));
  for (const auto& [name, value] : cloud.numbers)
    out.add(fmt::format(
        "<DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" format=\"binary\">{}</DataArray>\n",
        name, encoded(std::vector<double>{value})));
  out.add(
      fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                  "NumberOfStrips=\"0\" "
                  "NumberOfPolys=\"0\">\n<PointData>\n",
                  n));
  for (const auto& a : cloud.arrays) array(out, "Float64", a.name, a.components, a.values);
  out.add("</PointData>\n<Points>\n");
  array(out, "Float64", "Points", 3, places);
  out.add("</Points>\n<Verts>\n");
  array(out, "Int64", "connectivity", 1, points);
  array(out, "Int64", "offsets", 1, ends);
  out.add("</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
  out.close();
}

}  // namespace tripoint
