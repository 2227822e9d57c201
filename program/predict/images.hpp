// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <vector>

#include "program/predict/shares.hpp"

namespace tripoint::predict {

/// Periodic images of these points within `reach` of the domain, in the directions `seen`.
[[nodiscard]] std::vector<Point> images_within(const std::vector<Point>& members,
                                               const std::array<bool, 3>& seen, const Vec3& min,
                                               const Vec3& max, double reach);

}  // namespace tripoint::predict
