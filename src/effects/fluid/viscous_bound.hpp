// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

#include "effects/world.hpp"
#include "sph/pass.hpp"

namespace tripoint::fluid {

/// Greatest stable step of the viscous pair forces (model 8.10), formed anew every few steps from the present places:
/// 1/max_i sum_j G_ij/m_i for (8) and `laplacian`; 0.6/max_i lambda_max(sum_j G_ij e e^T/m_i) for `central`.
class ViscousBound {
 public:
  void update(World&, const PairKernels&);
  [[nodiscard]] double dt() const noexcept { return dt_; }

 private:
  double dt_ = std::numeric_limits<double>::infinity();
  int calls_ = 0;
};

}  // namespace tripoint::fluid
