// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"

/// The machine's limit: the pair loops of one scene fused by hand, in the best layout known. `tripoint bench`
/// compares the solver's own passes with them. They know nothing of columns, slots, groups or bodies.
namespace tripoint::bench {

/// Columns that the loops read, and those that they add to, each padded by one vector. The seed's forms read
/// the first nine, the corrected ones all.
struct LaneColumns {
  enum : std::size_t {
    x,
    y,
    z,
    u,
    v,
    w,
    pressure,
    volume,
    temperature,
    viscosity,
    conductivity,
    moment,
    count = moment + 6
  };
  std::array<AlignedVector<double>, count> of;
  /// Of the density loop: 1 or 7; of the rate loop: acceleration and heat
  std::array<AlignedVector<double>, 7> sum;
  std::size_t rows = 0;
};

/// Clusters of as many rows as a vector has lanes, which follow one another in a row of cells. Each lists the
/// rows in reach of any.
struct LaneLists {
  std::vector<std::uint32_t> first;  ///< row of each cluster, and the number of rows
  std::vector<std::size_t> start;    ///< of each cluster's list, one more at the end
  std::vector<std::uint32_t> partner;
  double pairs = 0.0;  ///< directed pairs within the support itself, without those of a particle and itself
};

/// Cells of reach/4 x reach x reach, so that the neighbours along x of a row of cells are one stretch of
/// rows.
struct LaneCells {
  double low[3] = {}, per_width[3] = {};
  int count[3] = {};
  std::vector<std::uint32_t> first;  ///< row that starts each cell, one more at the end
};

/// The loops of one vector unit. A loop that a form does not need is null.
struct LaneLoops {
  int lanes = 1;
  void (*list)(const LaneColumns&, const LaneCells&, double support, double reach, int threads,
               LaneLists&) = nullptr;
  using Loop = void (*)(LaneColumns&, const LaneLists&, double support, int threads);
  Loop seed_density = nullptr, seed_rates = nullptr;  ///< (4); (7), (8), (21)
  Loop corrected_density = nullptr, corrected_rates = nullptr,
       corrected_heat = nullptr;  ///< model 8.2, 8.6; 8.3, 8.5, 8.6; 8.6 again
};

/// @tparam U the vector unit
template <class U>
[[nodiscard]] LaneLoops lane_loops();
/// The loops that this machine can run, the narrowest first.
[[nodiscard]] std::vector<LaneLoops> all_lane_loops();

}  // namespace tripoint::bench
