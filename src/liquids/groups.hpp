// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "particles/catalogue.hpp"
#include "state/body_table.hpp"
#include "state/state.hpp"

namespace tripoint::liquid {

/// The group of each row (field::group).
class Groups {
 public:
  explicit Groups(const State& state) : body_(state.particles[field::body]) {
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      const bool free = state.bodies[field::body_motion][b] == static_cast<int>(Motion::free);
      of_.push_back(!is_rigid(state, b) ? deformable_group
                    : free              ? 1.0 + static_cast<double>(b)
                                        : wall_group);
    }
  }
  [[nodiscard]] double operator()(std::size_t row) const {
    return body_[row] < 0 ? liquid_group : of_[static_cast<std::size_t>(body_[row])];
  }

 private:
  std::span<const int> body_;
  std::vector<double> of_;  ///< members of each body
};

}  // namespace tripoint::liquid
