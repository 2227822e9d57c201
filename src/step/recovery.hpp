// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "core/checkpoint.hpp"
#include "core/errors.hpp"

namespace tripoint {

/// Good states that a run can go back to when a guard trips, and how short its steps are since.
///
/// Two states are kept, every 128 steps a new one. A failure goes back to the older one, so that at least 128
/// steps lie between the state and the failure. Each failure halves the steps. They double again, up to the
/// full step, once 2^count good states lie past the last failure. A step that fails again and again is thus
/// tried ever more seldom.
class Recovery {
 public:
  static constexpr long steps_between_states = 128;
  static constexpr int most_halvings = 10;

  /// A state that all guards have passed. @param time of it [s]
  void keep(Checkpoint state, double time);
  /// The state to go on from, with half the steps. @throws Diverged, the failure with the attempts, after
  /// most_halvings in a row
  [[nodiscard]] const Checkpoint& go_back(const Diverged& failure);

  [[nodiscard]] double share() const noexcept { return share_; }  ///< of the full step
  [[nodiscard]] long count() const noexcept { return count_; }
  /// Guard that tripped last; empty = none did
  [[nodiscard]] const std::string& last() const noexcept { return last_; }

  /// Into and out of a run's checkpoint, so that a run that was cut goes back to the same states.
  void save(Checkpoint&) const;
  void restore(const Checkpoint&);

 private:
  std::optional<Checkpoint> older_, newer_;
  double share_ = 1.0, failed_at_ = -1.0;
  long count_ = 0, good_ = 0;  ///< failures; good states past the last one
  std::string last_;
};

}  // namespace tripoint
