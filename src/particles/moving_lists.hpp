// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "particles/neighbours.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"

/// Bonds and excluded pairs as numbers that go with their particle from process to process (decision 021).
/// Partners are named by their number among the particles of all processes, which never changes; here they
/// are ids again.
namespace tripoint {

/// The lists of one particle of a scene that is not shared out yet, where ids are numbers. First the number
/// of bonds and the number of excluded pairs. Then for each bond the partner, with 2^31 times the place in
/// its list, x [m], gradient [1/m4], weight [1/m3]. Then for each excluded pair its partner and weight
/// [1/m3].
[[nodiscard]] std::vector<double> lists_as_numbers(const Bonds&, const ExcludedPairs&, std::size_t id);
/// Greatest length of lists_as_numbers() over all particles; 0 where there are no lists at all.
[[nodiscard]] std::size_t most_list_numbers(const Bonds&, const ExcludedPairs&);

/// Particles of a scene that a process has: its own, ids 0..owned-1, and ghosts.
struct Share {
  std::size_t owned = 0;
  std::vector<int> number;  ///< of each id; ghosts of one particle at several images have the same
  std::function<std::span<const double>(std::size_t id)> lists;  ///< as lists_as_numbers() gave them
};
/// Builds the lists of these particles, by id. Lists of own particles are whole and keep their order, so that
/// sums over them keep their bits. The list of a copy has its pairs with own particles only. Excluded pairs
/// with particles that are not near are left out: they cannot meet.
/// @throws InputError naming both particles where an own particle has a bond with one that is not among the
/// ghosts
void take_lists(const Share&, Bonds&, ExcludedPairs&);

/// The longest bond of ids 0..owned-1 at the places of now, of nearest images [m]; 0 without bonds.
[[nodiscard]] double longest_bond(const Particles&, const Bonds&, std::size_t owned, const PeriodicBox&);

}  // namespace tripoint
