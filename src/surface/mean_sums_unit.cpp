// SPDX-License-Identifier: BSD-3-Clause
#include "surface/mean_sums.hpp"

/// Compiled once for each vector unit.
namespace tripoint {

template <>
MeanSumsFunction mean_sums_for<Unit>() {
  return &mean_sums<Unit>;
}

}  // namespace tripoint
