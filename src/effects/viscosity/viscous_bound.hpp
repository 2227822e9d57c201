// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

#include "pairs/pass.hpp"
#include "state/state.hpp"
#include "state/step_numbers.hpp"

namespace tripoint::viscosity {

/// Greatest stable step of viscosity, as last formed [s].
inline constexpr StepNumber viscous_step{"viscous_step", std::numeric_limits<double>::infinity(), true};
inline constexpr StepNumber viscous_age{"viscous_age", 0.0};  ///< rates since it was formed [1]

/// Greatest stable step of the viscous pair forces (model 8.10), formed anew every few steps from the present
/// places. (8) and `laplacian`: 0.5/max_i sum_j G_ij/m_i. `central`: 0.3/max_i lambda_max(sum_j G_ij e
/// e^T/m_i).
void update_viscous_bound(State&, const PairKernels&);

}  // namespace tripoint::viscosity
