// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>

#include "core/matrix3.hpp"

namespace tripoint::carried_liquid {

/// Inverse, blended into `rest` times the identity where the determinant is below `full`.
[[nodiscard]] inline Symmetric blended_inverse(const Symmetric& m, double full, double rest) {
  const double det = determinant(tripoint::full(m));
  if (!(det > 1e-9)) return {rest, rest, rest, 0.0, 0.0, 0.0};
  const double share = det / (det + std::max(full - det, 0.0));
  const Symmetric inverse = symmetric_part(tripoint::inverse(tripoint::full(m)));
  return share * inverse + ((1.0 - share) * rest) * Symmetric{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
}

}  // namespace tripoint::carried_liquid
