// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <functional>
#include <string>

namespace tripoint::ranks {

/// Is a rank in a process of its own, which this one waits for: how it ended is noted before MPI's process
/// manager learns of it. The manager itself does not always tell: it ends all other ranks at once, and may
/// then name one of these, or none.
/// @return exit code of the rank; where a signal ended it, this process ends by the same one
int keep_a_rank(const std::string& output, const std::function<int()>& be_a_rank);

}  // namespace tripoint::ranks
