// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/step_numbers.hpp"

/// What a scene keeps of particles that have left it (field::number).
namespace tripoint::left_numbers {

inline constexpr StepNumber ever{"particles_ever", 0.0};      ///< particles that were ever there [1]
inline constexpr StepNumber left{"particles_left", 0.0};      ///< of these, those that have left [1]
inline constexpr StepNumber mass{"mass_left", 0.0};           ///< that they took [kg]
inline constexpr StepNumber px{"momentum_left_x", 0.0};       ///< the same [kg m/s]
inline constexpr StepNumber py{"momentum_left_y", 0.0};       ///< the same [kg m/s]
inline constexpr StepNumber pz{"momentum_left_z", 0.0};       ///< the same [kg m/s]
inline constexpr StepNumber waited{"steps_since_look", 0.0};  ///< steps since all were looked at [1]

}  // namespace tripoint::left_numbers
