// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

namespace tripoint::liquid {

/// The velocities that viscous pairs see: those at the full step, by the rates of the last one. @param ahead
/// half a step [s]
void predict_velocities(State&, double ahead, const VectorField<double>& target);

/// The velocities with which all has come where it is. Members of rigid bodies have those at the start of the
/// drift still: the mean with those at its end.
void velocities_of_way(State&, const VectorField<double>& target);

}  // namespace tripoint::liquid
