// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <sys/resource.h>

#include <functional>
#include <string>

#include "core/errors.hpp"

/// A copy of this process reads third-party files; it can do nothing but read and hand bytes back. No library
/// is sure to survive every file: one that it does not survive costs a copy. Code that a file brings along
/// finds no network, no program to start, no process to signal and no file to write.
namespace tripoint {

/// Memory of this machine [bytes].
[[nodiscard]] rlim_t machine_memory();

/// Bounds of a copy.
struct CopyBounds {
  std::string what;                  ///< is read, for the words of errors: "trajectory.h5"
  double wall_limit = 0.0;           ///< wall clock [s]; then it is killed
  rlim_t memory = machine_memory();  ///< address space that it may take besides ours [bytes]
  rlim_t most_bytes = memory / 4;    ///< that it may hand back
  std::string folder = {};           ///< the files below it are all that it may open; "" = none
  bool must_be_confined = false;     ///< where the system cannot confine it, nothing is read
};

/// How a copy ended.
struct CopyEnd {
  enum class How {
    read,          ///< it handed back the bytes that it read
    refused,       ///< the reader threw: rethrow()
    killed,        ///< by a signal, which `code` is
    late,          ///< it was killed at the limit
    no_memory,     ///< it needs more than it may have
    not_confined,  ///< this system has no seccomp, and it had to be confined
  } how = How::read;
  int code = 0;
  std::string bytes;  ///< bytes that it handed back; of a refusal, its words
  SourcePlace place;  ///< of a refusal
};

/// Calls `read` in a copy of this process and returns its result. The copy may ask for memory, open files of
/// one folder for reading (Landlock, where the system has it) and hand its bytes back. The system refuses all
/// else (seccomp). It has no open file of ours, and ends with us.
/// @pre no other thread is within a library that `read` uses, such as HDF5: its lock would stay closed in the
/// copy for ever
/// @throws std::system_error where no process, or no file for the result, is to spare
[[nodiscard]] CopyEnd read_in_confined_copy(const std::function<std::string()>& read, const CopyBounds&);

/// Why nothing was read: "trajectory.h5 kills the library that reads it (signal 11, Segmentation fault)".
/// Empty where it was, and where the reader refused it.
[[nodiscard]] std::string failure_of(const CopyEnd&, const CopyBounds&);

/// Throws here the error that the reader threw in the copy, if any. @throws InputError
void rethrow(const CopyEnd&);

}  // namespace tripoint
