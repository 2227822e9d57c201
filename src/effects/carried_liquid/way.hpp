// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/state.hpp"

namespace tripoint::carried_liquid {

/// The velocities with which all has come where it is. Members of rigid bodies have those at the start of the
/// drift still: the mean with those at its end.
void set_velocities_of_way(State&, const VectorField<double>& target);

}  // namespace tripoint::carried_liquid
