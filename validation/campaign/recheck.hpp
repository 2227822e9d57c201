// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/judge/remarks.hpp"

/// Results against the case files as they are now: the judged question must be that of the cases.
namespace tripoint {

/// Errors, exit 4. One stands for each case whose file cannot be read again, or whose metrics, gates,
/// studies, reference or `expect` are not those of the results. One stands for each case of which an engine
/// or a planned run has no row. One stands for each value that is not the norm of its own series. One stands
/// for each missing case that the profile, tag or folder of the results asks for now.
[[nodiscard]] std::vector<Remark> recheck_remarks(const Results&);

}  // namespace tripoint
