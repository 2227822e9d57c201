// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/lanes.hpp"
#include "core/vec3.hpp"
#include "particles/entry.hpp"

namespace tripoint {

/// Places [from, to) in the order of (cell, id), seen in one image of the box: where neighbours of a cluster
/// may be.
struct CandidateRange {
  std::uint32_t from, to, image;
};

/// Input for the list of one cluster.
struct Scan {
  const double *x, *y, *z;  ///< positions by row, readable a whole vector past the last [m]
  std::size_t first;        ///< first row of the cluster
  unsigned members;         ///< bit l where first + l is a member
  const CandidateRange* ranges;
  std::size_t count;
  const Vec3* shift;           ///< of each image [m]
  double reach2;               ///< [m2]
  const std::uint32_t* order;  ///< the row of each place; null: rows are in this order
  /// Row from which on a pair counts for two, where there is an order: see Neighbours
  std::size_t twice_from;
};

/// How many entries a scan wrote, and how many pairs they are.
struct Scanned {
  std::size_t entries, pairs;
};

/// Writes the candidates within reach of any member, in the order of the ranges, as in Entry. `near` gets the
/// bits of the members that each one is near to. Both must have room for all candidates.
using ScanFunction = Scanned (*)(const Scan&, std::uint32_t* rows, std::uint8_t* near);

template <int L, class ForUnit, bool ordered>
Scanned scan_places(const Scan& s, std::uint32_t* rows, std::uint8_t* near) {
  using V = typename Lanes<L>::Real;
  // Bytes are written to `near`, which might be those of the input: what the loop reads of it is read once.
  const double *const x = s.x, *const y = s.y, *const z = s.z;
  const std::uint32_t *const order = s.order, first = static_cast<std::uint32_t>(s.first);
  const V xi = load_lanes<L>(x + first), yi = load_lanes<L>(y + first), zi = load_lanes<L>(z + first);
  const double reach2 = s.reach2;
  const unsigned members = s.members;
  const std::size_t twice_from = s.twice_from;
  std::size_t n = 0, pairs = 0;
  for (const CandidateRange *range = s.ranges, *const past = s.ranges + s.count; range != past; ++range) {
    const CandidateRange places = *range;
    const Vec3 shift = s.shift[places.image];
    const std::uint32_t image = Entry::of(0, places.image).bits;
    const auto look = [&]<bool box_itself> {
      for (std::uint32_t place = places.from; place < places.to; ++place) {
        const std::uint32_t j = ordered ? order[place] : place;
        V dx = x[j] - xi, dy = y[j] - yi, dz = z[j] - zi;
        if constexpr (!box_itself) {
          dx += shift.x;
          dy += shift.y;
          dz += shift.z;
        }
        const V r2 = dx * dx + dy * dy + dz * dz;
        unsigned bits = bits_of<L>(r2 < reach2) & members;
        // a member itself
        if (box_itself && j - first < static_cast<std::uint32_t>(L)) bits &= ~(1u << (j - first));
        rows[n] = image | j;
        near[n] = static_cast<std::uint8_t>(bits);
        n += bits != 0;
        pairs += static_cast<std::size_t>(std::popcount(bits)) << (ordered && j >= twice_from ? 1 : 0);
      }
    };
    if (places.image == Entry::box_itself)
      look.template operator()<true>();
    else
      look.template operator()<false>();
  }
  return {n, pairs};
}

template <int L, class ForUnit>
[[gnu::flatten]] Scanned scan(const Scan& s, std::uint32_t* rows, std::uint8_t* near) {
  return s.order ? scan_places<L, ForUnit, true>(s, rows, near)
                 : scan_places<L, ForUnit, false>(s, rows, near);
}

/// The scan that is compiled for a vector unit, for clusters as wide as it.
template <class ForUnit>
[[nodiscard]] ScanFunction scan_for();

/// The scan for clusters of that many particles, made for the machine's vectors where there are some.
/// @param lanes 1, 2, 4 or 8   @throws InputError for another
[[nodiscard]] ScanFunction scan_of(int lanes);

}  // namespace tripoint
