// SPDX-License-Identifier: BSD-3-Clause
// A mesh: the first byte chooses the format, the rest is the file.
#include <algorithm>

#include "core/errors.hpp"
#include "fuzz/input.hpp"
#include "mesh/mesh_files.hpp"

using namespace tripoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const fuzz::Folder folder;
  const bool obj = data[0] & 1;
  const std::string text = fuzz::text_of(data + 1, size - 1);
  try {
    static_cast<void>(obj ? parse_obj(text, "mesh.obj") : parse_stl(text, "mesh.stl"));
    const Mesh mesh = read_mesh(folder.write(obj ? "mesh.obj" : "mesh.stl", text), 1.0);
    for (const auto& triangle : mesh.triangles)
      fuzz::expect(std::all_of(triangle.begin(), triangle.end(),
                               [&](auto corner) { return corner < mesh.points.size(); }),
                   "every corner of a mesh that is read is there");
    static_cast<void>(volume(mesh));
  } catch (const InputError&) {
  }
  return 0;
}
