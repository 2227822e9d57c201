// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "effects/carried_liquid/phase_density.hpp"
#include "state/state.hpp"

/// Pressure of a solid where liquid touches it: p_s = modulus squeeze. The liquid changes it by the rate that
/// is the adjoint of the force, so that the two keep energy, momentum and angular momentum.
namespace tripoint::carried_liquid {

/// Columns of which the squeeze of a solid follows.
class Squeezes {
 public:
  explicit Squeezes(const State&);
  /// At the end of the drift, drawn towards the pressure that the liquid has there; at the start that
  /// pressure. @param rate of the draw [1/s] @param taken energy that the draw adds [J]
  [[nodiscard]] double next(std::size_t row, const CarriedState&, double dt, double rate,
                            double& taken) const;

 private:
  std::span<const double> squeeze_, touching_, pressed_, divergence_, mass_, rest_;
};

/// What freezes or melts keeps its pressure. @pre its impedance is that of its new phase
void keep_pressure(State&, std::size_t row, bool was_liquid);

}  // namespace tripoint::carried_liquid
