// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tripoint::bench {

/// Bytes of this process in memory now.
[[nodiscard]] double resident_bytes();
/// Greatest resident_bytes() since restart_peak(), or since the start where the kernel does not let it be set
/// back.
[[nodiscard]] double peak_bytes();
/// Gives freed memory back and lets the peak count from now.
void restart_peak();

}  // namespace tripoint::bench
