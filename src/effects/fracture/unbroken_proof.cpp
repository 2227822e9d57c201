// SPDX-License-Identifier: BSD-3-Clause
#include "effects/fracture/unbroken_proof.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint::fracture {

void UnbrokenProof::set(const State& state, double headroom) {
  headroom_ = headroom - 1e-9 * state.scene.spacing;  // far above round-off
  const Particles& p = state.particles;
  place_.resize(p.size());
  const auto x = positions(p);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t id = 0; id < p.size(); ++id) place_[id] = x.at(p.row(id));
}

/// |r_i - r_j| of two particles that moved by d_i and d_j grows by |d_i - d_j| at most, so by twice the
/// greatest |d - d_0|. One that came back at the other side of a periodic box has moved far: then all are
/// looked at again.
bool UnbrokenProof::holds(const State& state) const {
  const Particles& p = state.particles;
  if (place_.empty() || place_.size() != p.size() || !(headroom_ > 0.0)) return false;
  const auto x = positions(p);
  const Vec3 all = x.at(p.row(0)) - place_[0];
  double most = 0.0;
#pragma omp parallel for schedule(static) num_threads(state.threads) reduction(max : most)
  for (std::size_t id = 0; id < p.size(); ++id) {
    const Vec3 d = (x.at(p.row(id)) - place_[id]) - all;
    most = std::max(most, dot(d, d));
  }
  return 2.0 * std::sqrt(most) < headroom_;
}

}  // namespace tripoint::fracture
