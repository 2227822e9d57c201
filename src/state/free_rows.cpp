// SPDX-License-Identifier: BSD-3-Clause
#include "state/free_rows.hpp"

#include "core/machine.hpp"
#include "state/state.hpp"

namespace tripoint {

FreeLoops free_loops(std::size_t forces) {
  if (machine_has_avx512()) return free_loops_for<Avx512>(forces);
  return machine_has_avx2() ? free_loops_for<Avx2>(forces) : free_loops_for<Any>(forces);
}

FreeRows free_rows(const State& state) {
  const Particles& p = state.particles;
  FreeRows rows;
  rows.forces = state.forces.size();
  std::size_t column = 0;
  for (const Force& force : state.forces)
    for (const Field<double>* f : columns_of(force.field.get())) rows.force[column++] = p[*f].data();
  rows.m = p[field::mass].data();
  const Vec3 g = state.scene.gravity;
  rows.g = {g.x, g.y, g.z};
  return rows;
}

}  // namespace tripoint
