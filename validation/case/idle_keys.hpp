// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/case/preflight.hpp"

namespace tripoint {

/// What the case says and no run of it can show: an event whose region holds nothing, a release of what is free, a key that no
/// effect of the scene reads. An error where it is certain, else a warning.
[[nodiscard]] std::vector<Finding> idle_keys(const CaseReading&, const Scene&, const InitialState&);

}  // namespace tripoint
