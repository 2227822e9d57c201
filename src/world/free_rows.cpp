// SPDX-License-Identifier: BSD-3-Clause
#include "world/free_rows.hpp"

#include "core/machine.hpp"
#include "world/world.hpp"

namespace tripoint {

FreeLoops free_loops(std::size_t forces) {
  if (machine_has_avx512()) return free_loops_for<Avx512>(forces);
  return machine_has_avx2() ? free_loops_for<Avx2>(forces) : free_loops_for<Any>(forces);
}

FreeRows free_rows(const World& world) {
  const Particles& p = world.particles;
  FreeRows rows;
  rows.forces = world.forces.size();
  std::size_t column = 0;
  for (const Force& force : world.forces)
    for (const Field<double>* f : {&force.x, &force.y, &force.z}) rows.force[column++] = p[*f].data();
  rows.m = p[field::mass].data();
  const Vec3 g = world.scene.gravity;
  rows.g = {g.x, g.y, g.z};
  return rows;
}

}  // namespace tripoint
