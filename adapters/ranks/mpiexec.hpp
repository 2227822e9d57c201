// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>

namespace tripoint::ranks {

/// Runs this program as ranks of a job under the wheel's mpiexec, and waits. Where they leave no result.json,
/// it is written from the statements of the ranks. @return exit code of the engine protocol @param job_path
/// as it was handed to this program
int run_ranks(const std::string& job_path);

}  // namespace tripoint::ranks
