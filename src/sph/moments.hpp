// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/matrix3.hpp"

namespace tripoint {

/// Pseudo-inverse by eigenvalues; those below `cut` times the largest count as none. The zero matrix gives zero.
/// @param m positive semidefinite   @param cut in 0..1 (0.05 for heat, model 8.6)
[[nodiscard]] Symmetric pseudo_inverse(const Symmetric& m, double cut);

/// Largest eigenvalue.
[[nodiscard]] double largest_eigenvalue(const Symmetric& m);

}  // namespace tripoint
