// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>

namespace tripoint::ranks {

/// `engine-tripoint-mpi --probe`: times MPI between two ranks on this machine, a few seconds long, and prints
/// one JSON object. It has the seconds of a pair's exchange over sizes in bytes, and of an allreduce of 1 and
/// of 1024 doubles. It also has the bytes a second at which scattered numbers are packed. Each is the best of
/// many.
/// @return 0, or 4 where the wheel is missing or a rank failed, with the reason on stderr
int probe();

/// One rank of it. @param path where rank 0 writes the object
int be_a_probe(const std::string& path);

}  // namespace tripoint::ranks
