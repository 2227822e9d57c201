// SPDX-License-Identifier: BSD-3-Clause
#include "state/free_rows.hpp"

/// Compiled once for each vector unit, and once for any machine.
namespace tripoint {

template <>
FreeLoops free_loops_for<Unit>(std::size_t forces) {
  constexpr int lanes = TRIPOINT_UNIT_LANES;
  static constexpr auto all = []<std::size_t... n>(std::index_sequence<n...>) {
    return std::array{FreeLoops{&detail::kick<lanes, Unit, n>, &detail::predict<lanes, Unit, n>,
                                &detail::greatest_acceleration2<lanes, Unit, n>,
                                &detail::greatest_speed2<lanes, Unit>}...};
  }
  (std::make_index_sequence<most_forces + 1>{});
  return all[forces];
}

}  // namespace tripoint
