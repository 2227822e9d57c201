// SPDX-License-Identifier: BSD-3-Clause
#include "particles/scan.hpp"

/// Compiled once for each vector unit.
namespace tripoint {

template <>
ScanFunction scan_for<Unit>() {
  return &scan<TRIPOINT_UNIT_LANES, Unit>;
}

}  // namespace tripoint
