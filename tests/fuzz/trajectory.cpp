// SPDX-License-Identifier: BSD-3-Clause
// trajectory.h5 as a file whose datasets have any shapes, types and values: what the library reads soundly,
// and our reader must bear. Files that the library itself does not bear are read in a child of the harness
// (docs/promises.md).
#include <hdf5.h>

#include <array>

#include "core/errors.hpp"
#include "files/trajectory.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

namespace {

struct Element {
  const char *name, *unit;
  bool whole;
  hsize_t width;
};
constexpr std::array<Element, 22> elements{{{"particles/all/position", "m", false, 3},
                                            {"particles/all/velocity", "m s-1", false, 3},
                                            {"particles/all/mass", "kg", false, 1},
                                            {"particles/all/temperature", "K", false, 1},
                                            {"particles/all/density", "kg m-3", false, 1},
                                            {"particles/all/id", "", true, 1},
                                            {"particles/all/phase", "", true, 1},
                                            {"particles/all/body", "", true, 1},
                                            {"particles/all/material", "", true, 1},
                                            {"particles/bodies/position", "m", false, 3},
                                            {"particles/bodies/velocity", "m s-1", false, 3},
                                            {"particles/bodies/angular_velocity", "rad s-1", false, 3},
                                            {"particles/bodies/force", "N", false, 3},
                                            {"particles/bodies/torque", "N m", false, 3},
                                            {"particles/bodies/orientation", "1", false, 4},
                                            {"particles/bodies/mass", "kg", false, 1},
                                            {"observables/mass", "kg", false, 1},
                                            {"observables/momentum", "kg m s-1", false, 3},
                                            {"observables/angular_momentum", "kg m2 s-1", false, 3},
                                            {"observables/energy_kinetic", "J", false, 1},
                                            {"observables/heat_plate", "J", false, 1},
                                            {"observables/count_objects", "1", false, 1}}};

void write_unit(hid_t dataset, const char* unit) {
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, std::strlen(unit) + 1);
  const hid_t attribute = H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, unit);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

/// A dataset of this shape (a hostile input bends it), filled from the input.
void write_dataset(fuzz::Bytes& bytes, hid_t file, const std::string& name, int rank,
                   std::array<hsize_t, 4> shape, bool whole, const char* unit) {
  if (bytes.one_of(16) == 0) rank = static_cast<int>(bytes.one_of(5));
  if (bytes.one_of(8) == 0) shape[bytes.one_of(4)] = bytes.one_of(6);
  if (bytes.one_of(16) == 0) whole = !whole;
  hsize_t count = 1;
  for (int k = 0; k < rank; ++k) count *= shape[static_cast<std::size_t>(k)];
  const hid_t space = rank > 0 ? H5Screate_simple(rank, shape.data(), nullptr)
                               : H5Screate(bytes.flag() ? H5S_SCALAR : H5S_NULL);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  const hid_t dataset = H5Dcreate2(file, name.c_str(), whole ? H5T_STD_I32LE : H5T_IEEE_F64LE, space, links,
                                   H5P_DEFAULT, H5P_DEFAULT);
  std::vector<double> values(count);
  for (double& v : values) v = whole ? bytes.byte() - 4 : bytes.real();
  if (dataset >= 0 && H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(count))
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  if (dataset >= 0 && unit) write_unit(dataset, bytes.one_of(32) == 0 ? "furlong" : unit);
  if (dataset >= 0) H5Dclose(dataset);
  H5Pclose(links);
  H5Sclose(space);
}

void write_file(fuzz::Bytes& bytes, const std::string& path) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (bytes.one_of(32) != 0) H5Gclose(H5Gcreate2(file, "h5md", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  const hsize_t frames = 1 + bytes.one_of(3), rows = bytes.one_of(4), bodies = bytes.one_of(3);
  for (const Element& e : elements) {
    if (bytes.one_of(8) == 0) continue;
    const std::string name = e.name;
    const hsize_t n = name.starts_with("particles/all")      ? rows
                      : name.starts_with("particles/bodies") ? bodies
                                                             : e.width;
    const int rank = e.width == 1 || name.starts_with("observables") ? 2 : 3;
    write_dataset(bytes, file, "/" + name + "/value", rank, {frames, n, e.width, 1}, e.whole, e.unit);
    write_dataset(bytes, file, "/" + name + "/time", 1, {frames, 1, 1, 1}, false, nullptr);
    write_dataset(bytes, file, "/" + name + "/step", 1, {frames, 1, 1, 1}, true, nullptr);
  }
  H5Fclose(file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  fuzz::Bytes bytes(data, size);
  write_file(bytes, folder / "trajectory.h5");
  try {
    const Trajectory trajectory = read_trajectory(folder / "trajectory.h5");
    for (const Snapshot& frame : trajectory.frames) {
      fuzz::expect(frame.velocity.empty() || frame.velocity.size() == frame.position.size(),
                   "columns of a frame are of one length");
      static_cast<void>(state_hash(frame));
    }
  } catch (const InputError&) {
  } catch (const EngineError&) {
  }
  return 0;
}
