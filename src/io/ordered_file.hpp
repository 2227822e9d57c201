// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <hdf5.h>

namespace tripoint::h5 {

/// Lets a file that is created by these access properties change in an order in which a process that dies between any two calls
/// leaves every frame flushed before it readable. HDF5 itself writes by address: where it splits a node of an index, the old node
/// has lost its last entries before anything leads to the new one. For src/io only.
/// @throws EngineError when HDF5 refuses
void write_in_order(hid_t access);

}  // namespace tripoint::h5
