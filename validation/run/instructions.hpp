// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "validation/run/process.hpp"

/// Instructions of an engine's run: a cost that does not depend on what else the machine does.
namespace tripoint {

/// User-space instructions of the programs that this thread starts while it lives, by the processor's own
/// counter. Where the kernel or the machine has none (most virtual machines), it counts nothing.
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  /// Instructions of all that was started and has ended; 0 = not counted.
  [[nodiscard]] double read() const;

 private:
  int fd_ = -1;
};

/// The same call once more under callgrind, which simulates every instruction: exact, and some fifty times
/// slower.
/// @return empty where valgrind is missing, or the run did not end well under it
[[nodiscard]] std::optional<double> callgrind_instructions(const ProcessSpec&);

/// Sum of the numbers behind "Collected :" in callgrind's log, one a process; empty when there is none.
[[nodiscard]] std::optional<double> collected_instructions(const std::string& log);

}  // namespace tripoint
