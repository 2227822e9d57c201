// SPDX-License-Identifier: BSD-3-Clause
#include "world/free_rows.hpp"

/// Compiled once for each vector unit, and once for any machine.
namespace tripoint {

template <>
FreeLoops free_loops_for<Unit>(std::size_t forces) {
  static constexpr auto all = []<std::size_t... n>(std::index_sequence<n...>) {
    return std::array{FreeLoops{&detail::kick<Unit, n>, &detail::predict<Unit, n>, &detail::greatest_acceleration2<Unit, n>,
                                &detail::greatest_speed2<Unit>}...};
  }
  (std::make_index_sequence<most_forces + 1>{});
  return all[forces];
}

}  // namespace tripoint
