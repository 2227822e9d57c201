// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace tripoint::ranks {

/// Seconds of each step of this process, in parts: work, and then a call of all ranks, which lasts as long as
/// another rank still works. A core that is slow for a while slows some parts of a run and others of its
/// repeat: whoever has several runs can compare the best of each part, and tell work from waiting.
class StepTimes {
 public:
  explicit StepTimes(std::string path) : path_(std::move(path)) {}
  /// Steps are about to be made. Parts since the last whole step are forgotten.
  void begin();
  /// Work has ended and a call begins. Of several before the end of the part the first counts.
  void begin_call();
  /// The call has ended, and the part with it.
  void end_part();
  /// A step has ended, and its last part with it, in which there is no call.
  void end_step();
  /// One line a step: wall seconds of work and of the call, and CPU seconds of both, for each part, with
  /// blanks between.
  /// @throws EngineError where the file cannot be written
  void write() const;

 private:
  struct Part {
    double work, call, cpu;  ///< [s]
  };

  std::string path_;
  double part_began_ = 0.0, call_began_ = 0.0, cpu_ = 0.0;  ///< clocks [s]
  bool in_call_ = false;
  std::vector<Part> parts_;               ///< of the step that is being made
  std::vector<std::vector<Part>> steps_;  ///< parts of each
};

}  // namespace tripoint::ranks
