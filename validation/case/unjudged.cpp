// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/unjudged.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tripoint {

std::vector<Finding> unjudged(const Case& value) {
  const bool expects = std::ranges::any_of(value.studies, [](const Study& s) { return s.expect.has_value(); });
  if (!value.gates.empty() || expects || value.expect == Expect::diverges) return {};
  const std::string gate =
      value.metrics.empty() ? "a [[metric]], and a [[gate]] on it with a limit and its reason"
                            : fmt::format("a [[gate]] with metric = \"{}\", a limit and its reason", value.metrics.front().name);
  return {
      {false,
       fmt::format("no gate judges this case: it can be run, but `tripoint validate` ends 4. Add {}; `tripoint new NAME` writes "
                   "a case that shows how",
                   gate),
       {value.file, 0, 0}}};
}

}  // namespace tripoint
