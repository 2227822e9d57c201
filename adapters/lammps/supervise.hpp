// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>

namespace tripoint::lammps {

/// Runs `child` in a process of its own, because a LAMMPS without exceptions ends its process on any error.
/// If the child ended without a result, and the log in the job's folder holds an error, the error becomes the
/// result. A signal is passed on.
/// @return the exit code
int supervise(const std::string& job_path, int (*child)(int, char**), int argc, char** argv);

}  // namespace tripoint::lammps
