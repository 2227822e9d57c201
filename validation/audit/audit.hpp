// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "files/result.hpp"

namespace tripoint {

struct InitialState;
struct Job;
struct Trajectory;

/// Refuses what cannot be judged: times missing to 1e-9 of the end, permuted ids, values outside their set,
/// frozen frames, and a run that contradicts itself (audit_parts.hpp).
/// @param held what the engine says that it holds: its precision and time step set how far a sound run may be
/// off
/// @return empty when sound, else the fault ("time not reached", "ids are permuted", ...)
[[nodiscard]] std::string audit(const Job&, const InitialState&, const Trajectory&,
                                const Readback& held = {});

}  // namespace tripoint
