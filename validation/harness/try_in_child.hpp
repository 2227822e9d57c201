// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

namespace tripoint {

/// Does this in a copy of this process first, so that what kills the copy does not kill us: a library that reads foreign files
/// and is not proof against them. What the copy throws is not told; it ends in the same way here.
/// @param what for the words of the error: "trajectory.h5"
/// @param limit wall clock [s]; then the copy is killed
/// @throws EngineError where the copy is killed, by itself or at the limit, or needs more memory than the machine has
void try_in_child(const std::function<void()>& deed, const std::string& what, double limit);

}  // namespace tripoint
