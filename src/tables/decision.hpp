// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/errors.hpp"

namespace tripoint {

/// One key of a case as it was resolved: from the file, or a default with its reason. Feeds `explain`.
struct Decision {
  std::string key, value, reason;
  bool given = false;  ///< the file says it
  SourcePlace place;
};

}  // namespace tripoint
