// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

namespace tripoint {

/// Symmetric 3x3 matrix by its six components.
struct Symmetric {
  double xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, xz = 0.0, xy = 0.0;
};

/// Pseudo-inverse by eigenvalues; those below `cut` times the largest count as none. The zero matrix gives zero.
/// @param m positive semidefinite   @param cut in 0..1 (0.05 for heat, model 8.6)
[[nodiscard]] Symmetric pseudo_inverse(const Symmetric& m, double cut);

/// Largest eigenvalue.
[[nodiscard]] double largest_eigenvalue(const Symmetric& m);

}  // namespace tripoint
