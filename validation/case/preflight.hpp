// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace tripoint {

struct Case;
struct CaseReading;
struct InitialState;
struct Scene;

/// One finding of the pre-flight check.
struct Finding {
  bool error = false;  ///< else a warning
  std::string what;    ///< with what to do
  SourcePlace place;
};
/// Overlaps and gaps, bodies under-resolved or of wrong mass, spins that move nothing, a time step above a
/// bound: without running anything.
[[nodiscard]] std::vector<Finding> preflight(const Case&, const Scene&, const InitialState&);

/// One warning for each [[material]] of the case that bears the name of one of the library and takes values
/// from it.
[[nodiscard]] std::vector<Finding> library_values(const CaseReading&);

/// One note for each number of [scene] that a word of [model] says.
[[nodiscard]] std::vector<Finding> old_keys(const CaseReading&);

}  // namespace tripoint
