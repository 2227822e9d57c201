// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace tripoint::ranks {

/// Wall and CPU seconds of each step of this process. A core that is slow for a while slows some steps of a run and others of its
/// repeat: whoever has several runs can compare the best of each step.
class StepTimes {
 public:
  explicit StepTimes(std::string path) : path_(std::move(path)) {}
  /// Steps are about to be made.
  void begin();
  /// One has been made, since begin() or the one before.
  void note();
  /// One line a step: both, with a blank between. @throws EngineError where the file cannot be written
  void write() const;

 private:
  std::string path_;
  std::array<double, 2> last_{};                ///< wall and CPU clock [s]
  std::vector<std::array<double, 2>> seconds_;  ///< of each step
};

}  // namespace tripoint::ranks
