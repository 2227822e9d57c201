// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/harness/remarks.hpp"

/// Results against the case files as they are now: what is judged must be what the cases ask.
namespace tripoint {

/// An error, exit 4, for each case whose file cannot be read again, whose metrics, gates, studies, reference or `expect` are not
/// those of the results, of which an engine or a planned run has no row, and for each value that is not the norm of its own
/// series. A case that the profile, tag or folder of the results asks for now and that is not among them is one too.
[[nodiscard]] std::vector<Remark> recheck_remarks(const Results&);

}  // namespace tripoint
