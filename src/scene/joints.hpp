// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene/scene.hpp"

namespace tripoint {

/// Whether a joint holds the two bodies to each other: they do not touch.
[[nodiscard]] bool has_joint(const Scene&, const std::string& a, const std::string& b);

}  // namespace tripoint
