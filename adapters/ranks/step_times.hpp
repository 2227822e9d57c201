// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace tripoint::ranks {

/// Wall and CPU seconds of each step of this process, in parts: what lies between two calls of all ranks. A core that is slow for
/// a while slows some parts of a run and others of its repeat: whoever has several runs can compare the best of each part.
class StepTimes {
 public:
  explicit StepTimes(std::string path) : path_(std::move(path)) {}
  /// Steps are about to be made. Parts since the last whole step are forgotten.
  void begin();
  /// A part has ended: since begin(), or the part before.
  void end_part();
  /// A step has ended, and its last part with it.
  void end_step();
  /// One line a step: both of each part, with blanks between. @throws EngineError where the file cannot be written
  void write() const;

 private:
  using Clocks = std::array<double, 2>;  ///< wall and CPU [s]
  [[nodiscard]] static Clocks clocks();

  std::string path_;
  Clocks last_{};
  std::vector<Clocks> parts_;               ///< of the step that is being made
  std::vector<std::vector<Clocks>> steps_;  ///< parts of each
};

}  // namespace tripoint::ranks
