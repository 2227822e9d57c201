// SPDX-License-Identifier: BSD-3-Clause
#include "solids/bond_loads.hpp"

#include <utility>

namespace tripoint::solid {

void add_bond_loads(State& state, const Rows& rows, std::span<const std::uint32_t> bonded,
                    std::span<const Matrix3> load) {
  Particles& p = state.particles;
  const auto id = p[field::id];
  const auto volume = std::as_const(p)[field::solid_volume];
  const auto F = triple(p, field::force);
#pragma omp parallel for schedule(static) num_threads(state.threads)
  for (std::size_t n = 0; n < bonded.size(); ++n) {
    const std::size_t i = bonded[n];
    if (!rows.has(i) || !state.owns(i)) continue;
    const auto own = static_cast<std::size_t>(id[i]);
    Vec3 f;
    for (const Bond& b : state.bonds.of(own)) {
      f += volume[p.row(b.other)] * (load[own] * b.gradient);
      f -= volume[i] * (load[b.other] * state.bonds.of(b.other)[b.twin].gradient);
    }
    F.set(i, F.at(i) + f);
  }
}

}  // namespace tripoint::solid
