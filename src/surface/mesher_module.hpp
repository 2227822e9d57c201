// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"
#include "surface/mesher.hpp"

namespace tripoint {

/// Triangles where a field changes its sign, by the module that holds OpenVDB, which is loaded at the first
/// call.
/// @param corners, values as tripoint_mesher_make takes them @param outside value of points that no block
/// holds
/// @return points in grid units; triangles counter-clockwise seen from where the field is positive
/// @throws EngineError where the module cannot be loaded, or fails
[[nodiscard]] Mesh sign_changes(const std::vector<std::int32_t>& corners, const std::vector<float>& values,
                                float outside);

}  // namespace tripoint
