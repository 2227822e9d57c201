// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <cstdlib>

namespace tripoint::ranks {

/// Ranks that this process starts from now on give their core away while they wait in a collective call.
/// MPICH's own way through shared memory looks at its flags ten thousand times before it does; its way by
/// messages gives way at every look that finds nothing. Settings that the user has made stay.
inline void let_waits_give_way() {
  for (const char* call :
       {"MPIR_CVAR_BCAST_POSIX_INTRA_ALGORITHM", "MPIR_CVAR_REDUCE_POSIX_INTRA_ALGORITHM",
        "MPIR_CVAR_ALLREDUCE_POSIX_INTRA_ALGORITHM", "MPIR_CVAR_BARRIER_POSIX_INTRA_ALGORITHM"})
    ::setenv(call, "mpir", 0);
}

}  // namespace tripoint::ranks
