// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>

#include "core/matrix3.hpp"
#include "state/state.hpp"

namespace tripoint::solid {

/// Adds to `force` what loads on particles do to their bonds, as the force of strain energy (12) does:
/// -v_l T gradW(x_kl) on the partner l of a bond of k and the opposite on k.
/// @param bonded rows that have a load, or a bond to one that has @param load by id, T = dU/dF A of k [J]
void add_bond_loads(State&, const Rows&, std::span<const std::uint32_t> bonded,
                    std::span<const Matrix3> load);

}  // namespace tripoint::solid
