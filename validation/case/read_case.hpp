// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "scene/defaults.hpp"
#include "tables/decision.hpp"
#include "validation/case/case.hpp"

namespace tripoint {

struct CaseReading {
  Case value;
  std::vector<Decision> decisions;
};

/// Reads and checks a case file; every default is filled in, every number is SI.
/// @param set "a.b=VALUE" replacements as of --set, applied before the checks
/// @throws InputError with file, line, column, what was wrong and the nearest known key or word
[[nodiscard]] CaseReading read_case(const std::string& path, const std::vector<std::string>& set = {});

/// The scene of one run of the case.
[[nodiscard]] inline Scene scene_for(const Case& c, const RunChoice& choice) {
  return scene_for(c.scene, choice);
}

/// Path of a case that is given as a path or as the id of a shipped case ("heat/cosine"). A path that is no
/// file comes back as it is.
[[nodiscard]] std::string case_path(const std::string& path_or_id);

}  // namespace tripoint
