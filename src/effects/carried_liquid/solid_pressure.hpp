// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/carried_liquid/phase_density.hpp"
#include "state/state.hpp"

/// Pressure of a solid s where liquids j touch it, their mean: p_s = sum_j V_j W (p_j - rho_j g.d)/sum_j V_j
/// W. It does work p_s V_s div_s. The liquids give it by the adjoint, a share of V_s div_s in the rate of
/// each, so that the pair keeps energy but for the weight in the mean.
namespace tripoint::carried_liquid {

/// V_s div_s over the share of liquid, of which WallRate takes the rates of the liquids.
/// @pre the pressures are those that acted in the last kick
void set_displaced(State&);
/// @pre the sums of WallPressure
void set_solid_pressure(State&);
/// What melts keeps its pressure. @pre its impedance is that of its new phase
void keep_pressure(State&, const CarriedState&, std::size_t row, bool was_liquid);

}  // namespace tripoint::carried_liquid
