// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "state/field_groups.hpp"

namespace tripoint::carried_liquid {

/// Columns that the effect of contact owns where solids meet.
[[nodiscard]] fields::List shared();
/// Columns of the effect. @param solids_meet  another effect owns those that are shared
[[nodiscard]] fields::List owned(bool solids_meet);

}  // namespace tripoint::carried_liquid
