// SPDX-License-Identifier: BSD-3-Clause
#include "particles/scan.hpp"

#include <string>

#include "core/errors.hpp"
#include "core/machine.hpp"

namespace tripoint {

template <>
ScanFunction scan_for<Avx2>();
template <>
ScanFunction scan_for<Avx512>();

ScanFunction scan_of(int lanes) {
  switch (lanes) {
    case 1:
      return &scan<1, Any>;
    case 2:
      return &scan<2, Any>;
    case 4:
      return machine_has_avx2() ? scan_for<Avx2>() : &scan<4, Any>;
    case 8:
      return machine_has_avx512() ? scan_for<Avx512>() : &scan<8, Any>;
    default:
      throw InputError("there are clusters of 1, 2, 4 and 8 particles, not of " + std::to_string(lanes));
  }
}

}  // namespace tripoint
