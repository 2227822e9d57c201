// SPDX-License-Identifier: BSD-3-Clause
// A filter as somebody else could lay it where the HDF5 library looks for plugins: it says that it was
// loaded, and changes nothing.
#include <H5PLextern.h>
#include <stdlib.h>

namespace {

__attribute__((constructor)) void leave_a_mark() { ::setenv("TRIPOINT_FOREIGN_FILTER", "was loaded", 1); }

std::size_t pass_through(unsigned, std::size_t, const unsigned*, std::size_t bytes, std::size_t*, void**) {
  return bytes;
}

const H5Z_class2_t filter{H5Z_CLASS_T_VERS, FOREIGN_FILTER, 1, 1, "foreign", nullptr, nullptr, pass_through};

}  // namespace

extern "C" {
H5PL_type_t H5PLget_plugin_type(void) { return H5PL_TYPE_FILTER; }
const void* H5PLget_plugin_info(void) { return &filter; }
}
