// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

namespace tripoint {

/// A file or text of a foreign engine.
struct ThirdPartyFile {
  std::string what;  ///< for the words of errors: "trajectory.h5"
  /// Where it lies: nothing else may be opened. "" = it is a text that we have already
  std::string folder = {};
};

/// Reads what an engine of others left or said, in a confined copy of this process. Under --sandbox nothing
/// is read where the system cannot confine it.
/// @param read returns its result as bytes
/// @param limit wall clock [s]; then the copy is killed
/// @returns what `read` returned in the copy
/// @throws InputError what `read` threw there
/// @throws EngineError where the copy is killed, by itself or at the limit, needs more memory than the
/// machine has, or could not be made
[[nodiscard]] std::string read_of_third_party(const std::function<std::string()>& read,
                                              const ThirdPartyFile& file, double limit);

/// Does this in such a copy first, so that a fault which kills the copy does not kill us. An error of the
/// copy is not reported: it ends in the same way here. @throws EngineError as read_of_third_party
void try_of_third_party(const std::function<void()>& deed, const ThirdPartyFile& file, double limit);

}  // namespace tripoint
