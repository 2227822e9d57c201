// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/checkpoint.hpp"

/// Checkpoints as files: HDF5 of the latest version, every array with fletcher32. A first block of 512 bytes
/// holds the checksum of all the rest. So a torn or altered file is refused before HDF5 reads one byte of it.
namespace tripoint {

/// Writes a new file under a temporary name, closes it, reads it back and compares. Then come fsync, rename
/// and fsync of the folder. A reader of `path` finds the earlier contents or all of the new, whenever this
/// process or the machine stops.
/// @throws EngineError naming the file when it cannot be written or does not read back the same
void write_checkpoint(const std::string& path, const Checkpoint&);

/// @throws InputError naming the file: not there, no checkpoint, of another version, torn or altered
[[nodiscard]] Checkpoint read_checkpoint(const std::string& path);

/// The same arrays with the same bits, NaN too.
[[nodiscard]] bool same_bits(const Checkpoint&, const Checkpoint&);

}  // namespace tripoint
