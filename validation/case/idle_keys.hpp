// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/case/preflight.hpp"

namespace tripoint {

/// Parts of the case that no run of it can show. For example: an event whose region is empty, a release of a
/// free body, a key that no effect reads. An error where it is certain, else a warning.
[[nodiscard]] std::vector<Finding> idle_keys(const CaseReading&, const Scene&, const InitialState&);

}  // namespace tripoint
