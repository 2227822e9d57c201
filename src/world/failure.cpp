// SPDX-License-Identifier: BSD-3-Clause
#include "world/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tripoint {

Diverged failure_of(const World& world, GuardName guard, std::size_t row, std::string_view field,
                    std::string_view stage, const std::string& what) {
  const Particles& p = world.particles;
  const int body = p[field::body][row], here = p[field::id][row];
  const int id = world.halo ? world.halo->numbers()[static_cast<std::size_t>(here)] : here;
  const std::string whose =
      body < 0 ? " (liquid)"
               : fmt::format(" of body \"{}\"", world.body_names[static_cast<std::size_t>(body)]);
  return {id,
          body,
          std::string(field),
          std::string(stage),
          world.time,
          fmt::format("particle {}{} {}, after {} at t = {:.9g} s", id, whose, what, stage, world.time),
          std::string(to_string(guard))};
}

void fail(const World& world, GuardName guard, std::size_t row, std::string_view field,
          std::string_view stage, const std::string& what) {
  throw failure_of(world, guard, row, field, stage, what);
}

bool is_off(const Scene& scene, GuardName guard) {
  return std::ranges::find(scene.unguarded, guard) != scene.unguarded.end();
}

}  // namespace tripoint
