// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <hdf5.h>

namespace tripoint::h5 {

/// Orders the changes to a file that is created by these access properties. A process may die between any two
/// calls, and every frame flushed before stays readable. HDF5 itself writes by address. Where it splits a
/// node of an index, the old node then loses its last entries before anything leads to the new one. For
/// src/files only.
/// @throws EngineError when HDF5 refuses
void write_in_order(hid_t access);

}  // namespace tripoint::h5
