// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"

namespace tripoint {

/// Whether a place is inside a shape, its surface included. @throws InputError for a mesh: an exact solution
/// has no use for one.
[[nodiscard]] bool inside(const Shape&, const Vec3& place);

}  // namespace tripoint
