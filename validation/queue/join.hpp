// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "validation/queue/queue.hpp"

namespace tripoint {

/// The results of a suite whose jobs are all done, judged: those that `tripoint validate` would have had, but
/// for times, dates and the command. Nothing is run; runs are copied to `out` where that is another folder
/// than DIR.
/// @throws InputError that names the jobs that are not done, or that are not of the cases and engines that
/// are here
[[nodiscard]] Results join(const std::string& dir, const Queue&, const std::vector<EngineEntry>&,
                           const std::string& out, const std::function<void(const CaseResult&)>& on_case);

}  // namespace tripoint
