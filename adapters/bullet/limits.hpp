// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "files/job.hpp"

namespace tripoint::bullet {

/// Why Bullet cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_not(const Job&);

/// The step of the engine's settings, else the job's, else 1/240 s. [s]
[[nodiscard]] double wanted_time_step(const Job&);

}  // namespace tripoint::bullet
