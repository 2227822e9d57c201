// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "particles/neighbours.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"

/// Bonds and own pairs as numbers that go with their particle from process to process (decision 021). Partners are named by their
/// number among the particles of all processes, which never changes; here they are ids again.
namespace tripoint {

/// The lists of one particle of a scene that is not shared out yet, where ids are numbers: how many bonds, how many own pairs;
/// then of each bond the partner, x [m], gradient [1/m4] and weight [1/m3], and of each own pair the partner and its weight
/// [1/m3].
[[nodiscard]] std::vector<double> lists_as_numbers(const Bonds&, const OwnPairs&, std::size_t id);
/// What the longest of them takes; 0 where there are no lists at all.
[[nodiscard]] std::size_t most_list_numbers(const Bonds&, const OwnPairs&);

/// What a process has of a scene: particles of its own, ids 0..owned-1, and copies.
struct Share {
  std::size_t owned = 0;
  std::vector<int> number;  ///< of each id; copies of one particle at several images have the same
  std::function<std::span<const double>(std::size_t id)> lists;  ///< as lists_as_numbers() gave them
};
/// Lists by id of these particles. Those of its own are whole and in the order that they always had, so that sums over them keep
/// their bits; of a copy there is what it has with its own. Own pairs with what is not near are left out: they cannot meet.
/// @throws InputError naming both particles where a bond of its own is with one that is not among the copies
void take_lists(const Share&, Bonds&, OwnPairs&);

/// The longest bond of ids 0..owned-1 at the places of now, of nearest images [m]; 0 without bonds.
[[nodiscard]] double longest_bond(const Particles&, const Bonds&, std::size_t owned, const PeriodicBox&);

}  // namespace tripoint
