// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace tripoint {

/// Key of Snapshot::gauges under which the standard error of a gauge stands, where the engine states one. No
/// name of a metric contains a line end.
[[nodiscard]] inline std::string gauge_error_key(const std::string& gauge) {
  return gauge + "\nstandard error";
}

}  // namespace tripoint
