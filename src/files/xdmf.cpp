// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <string>

#include "core/written_file.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

std::string item(std::size_t frame, std::size_t frames, std::size_t n, std::size_t width,
                 const std::string& element, bool whole) {
  const std::string tail = width > 1 ? fmt::format(" {}", width) : "", zero = width > 1 ? " 0" : "",
                    one = width > 1 ? " 1" : "";
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{1}{2}\"><DataItem Dimensions=\"3 {8}\" "
      "Format=\"XML\">{3} 0{4} 1 1{5} 1 "
      "{1}{2}</DataItem>"
      "<DataItem Format=\"HDF\" NumberType=\"{6}\" Precision=\"{9}\" Dimensions=\"{0} "
      "{1}{2}\">trajectory.h5:/particles/all/{7}/value</DataItem></DataItem>",
      frames, n, tail, frame, zero, one, whole ? "Int" : "Float", element, width > 1 ? 3 : 2, whole ? 4 : 8);
}

void attribute(std::string& out, const std::string& name, const std::string& data, bool vector) {
  out += fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name,
                     vector ? "Vector" : "Scalar", data);
}

}  // namespace

void write_xdmf(const std::string& folder, const std::vector<double>& times, const Snapshot& s) {
  std::string out =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain><Grid GridType=\"Collection\" "
      "CollectionType=\"Temporal\">\n";
  const std::size_t frames = times.size(), n = s.position.size();
  for (std::size_t f = 0; f < frames; ++f) {
    out += fmt::format(
        "<Grid><Time Value=\"{:.17g}\"/><Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n",
        times[f], n);
    out += "<Geometry GeometryType=\"XYZ\">" + item(f, frames, n, 3, "position", false) + "</Geometry>\n";
    attribute(out, "velocity", item(f, frames, n, 3, "velocity", false), true);
    const auto real = [&](const char* name, const std::vector<double>& column) {
      if (!column.empty()) attribute(out, name, item(f, frames, n, 1, name, false), false);
    };
    const auto whole = [&](const char* name, const std::vector<int>& column) {
      if (!column.empty()) attribute(out, name, item(f, frames, n, 1, name, true), false);
    };
    real("mass", s.mass);
    real("temperature", s.temperature);
    real("temperature_error", s.temperature_error);
    real("density", s.density);
    real("pressure", s.pressure);
    real("liquid_fraction", s.liquid_fraction);
    whole("id", s.id);
    whole("phase", s.phase);
    whole("body", s.body);
    whole("material", s.material);
    out += "</Grid>\n";
  }
  out += "</Grid></Domain></Xdmf>\n";
  WrittenFile file(folder + "/trajectory.xdmf");
  file.add(out);
  file.close();
}

}  // namespace tripoint
