// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// Points with values, to be looked at.
struct PointCloud {
  struct Array {
    std::string name;            ///< with its unit, "density [kg/m3]"
    std::size_t components = 1;  ///< values a point
    std::vector<double> values;
  };
  std::vector<Vec3> place;  ///< finite [m]
  std::vector<Array> arrays;
  std::vector<std::pair<std::string, double>> numbers;  ///< of the whole cloud: time, culprit
};

/// A VTK file of polygonal data (.vtp, XML), one vertex a point. Values are binary, so that NaN and infinity
/// are kept as they are.
/// @throws EngineError when it cannot be written
void write_vtp(const std::string& path, const PointCloud&);

}  // namespace tripoint
