// SPDX-License-Identifier: BSD-3-Clause
#include "state/failure.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tripoint {

Diverged failure_of(const State& state, GuardName guard, std::size_t row, std::string_view field,
                    std::string_view stage, const std::string& what) {
  const Particles& p = state.particles;
  const int body = p[field::body][row], here = p[field::id][row];
  const int id = state.halo ? state.halo->numbers()[static_cast<std::size_t>(here)] : here;
  const std::string whose =
      body < 0 ? " (liquid)"
               : fmt::format(" of body \"{}\"", state.body_names[static_cast<std::size_t>(body)]);
  return {id,
          body,
          std::string(field),
          std::string(stage),
          state.time,
          fmt::format("particle {}{} {}, after {} at t = {:.9g} s", id, whose, what, stage, state.time),
          std::string(to_string(guard))};
}

void fail(const State& state, GuardName guard, std::size_t row, std::string_view field,
          std::string_view stage, const std::string& what) {
  throw failure_of(state, guard, row, field, stage, what);
}

bool is_off(const Scene& scene, GuardName guard) {
  return std::ranges::find(scene.unguarded, guard) != scene.unguarded.end();
}

}  // namespace tripoint
