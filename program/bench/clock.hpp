// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>

namespace tripoint::bench {

using Clock = std::chrono::steady_clock;
/// Wall seconds from then till now.
[[nodiscard]] inline double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace tripoint::bench
