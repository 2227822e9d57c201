// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cstring>

#include "program/bench/lane_terms.hpp"

/// Compiled once for each vector unit.
namespace tripoint::bench {
namespace {

constexpr int L = TRIPOINT_UNIT_LANES;
using V = Lanes<L>::Real;

template <class Terms>
void sweep(LaneColumns& c, const LaneLists& lists, double support, int threads) {
  constexpr std::size_t reads = Terms::reads.size(), sums = Terms::sums;
  const double *x = c.of[0].data(), *y = c.of[1].data(), *z = c.of[2].data();
  std::array<const double*, reads> column{};
  for (std::size_t k = 0; k < reads; ++k) column[k] = c.of[Terms::reads[k]].data();
  std::array<double*, sums> target{};
  for (std::size_t k = 0; k < sums; ++k) target[k] = c.sum[k].data();
  const std::size_t clusters = lists.first.size() - 1;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t n = 0; n < clusters; ++n) {
    const std::size_t row = lists.first[n], bytes = (lists.first[n + 1] - row) * sizeof(double);
    const V x_i = load_lanes<L>(x + row), y_i = load_lanes<L>(y + row), z_i = load_lanes<L>(z + row);
    std::array<V, reads> i{};
    for (std::size_t k = 0; k < reads; ++k) i[k] = load_lanes<L>(column[k] + row);
    std::array<V, sums> sum{};
    for (std::size_t e = lists.start[n]; e < lists.start[n + 1]; ++e) {
      const std::size_t j_row = lists.partner[e];
      const V dx = x[j_row] - x_i, dy = y[j_row] - y_i, dz = z[j_row] - z_i;
      std::array<double, reads> j{};
      for (std::size_t k = 0; k < reads; ++k) j[k] = column[k][j_row];
      Terms::pair(LanePair<V>{dx, dy, dz, dx * dx + dy * dy + dz * dz, support}, i.data(), j.data(),
                  sum.data());
    }
    for (std::size_t k = 0; k < sums; ++k) std::memcpy(target[k] + row, &sum[k], bytes);
  }
}

/// Rows along x of the cells around a cluster.
struct Block {
  int low[3], high[3];
};

Block block_of(const LaneColumns& c, const LaneCells& cells, std::size_t from, std::size_t to) {
  constexpr int finer[3] = {4, 1, 1};
  Block b{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [least, most] = std::minmax_element(c.of[a].data() + from, c.of[a].data() + to);
    const auto cell = [&](double r) { return static_cast<int>((r - cells.low[a]) * cells.per_width[a]); };
    b.low[a] = std::max(0, cell(*least) - finer[a]);
    b.high[a] = std::min(cells.count[a] - 1, cell(*most) + finer[a]);
  }
  return b;
}

/// Appends the rows in reach of any lane. @return pairs within the support, of lanes below `lanes`
double list_cluster(const LaneColumns& c, const LaneCells& cells, double support2, double reach2,
                    std::size_t row, std::size_t lanes, std::vector<std::uint32_t>& out) {
  const double *x = c.of[0].data(), *y = c.of[1].data(), *z = c.of[2].data();
  const V x_i = load_lanes<L>(x + row), y_i = load_lanes<L>(y + row), z_i = load_lanes<L>(z + row),
          edge = V{} + reach2, inner = V{} + support2;
  const unsigned used = (1u << lanes) - 1u;
  const Block b = block_of(c, cells, row, row + lanes);
  double pairs = 0.0;
  for (int kz = b.low[2]; kz <= b.high[2]; ++kz) {
    for (int ky = b.low[1]; ky <= b.high[1]; ++ky) {
      const std::size_t line =
          static_cast<std::size_t>(cells.count[0]) * static_cast<std::size_t>(ky + cells.count[1] * kz);
      const std::uint32_t from = cells.first[line + static_cast<std::size_t>(b.low[0])],
                          to = cells.first[line + static_cast<std::size_t>(b.high[0]) + 1];
      std::size_t n = out.size();
      out.resize(n + (to - from));
      for (std::uint32_t j = from; j < to; ++j) {
        const V dx = x[j] - x_i, dy = y[j] - y_i, dz = z[j] - z_i, r2 = dx * dx + dy * dy + dz * dz;
        out[n] = j;
        n += (bits_of<L>(r2 < edge) & used) != 0u ? 1 : 0;
        pairs += std::popcount(bits_of<L>(r2 < inner) & used);
      }
      out.resize(n);
    }
  }
  return pairs - static_cast<double>(lanes);  // without each particle itself
}

void list(const LaneColumns& c, const LaneCells& cells, double support, double reach, int threads,
          LaneLists& lists) {
  lists.first.clear();
  const std::size_t lines =
                        static_cast<std::size_t>(cells.count[1]) * static_cast<std::size_t>(cells.count[2]),
                    width = static_cast<std::size_t>(cells.count[0]);
  for (std::size_t line = 0; line < lines; ++line)
    for (std::uint32_t row = cells.first[line * width]; row < cells.first[(line + 1) * width]; row += L)
      lists.first.push_back(row);
  const std::size_t clusters = lists.first.size(), parts = static_cast<std::size_t>(threads);
  lists.first.push_back(static_cast<std::uint32_t>(c.rows));
  lists.start.assign(clusters + 1, 0);
  std::vector<std::vector<std::uint32_t>> part(parts);
  double pairs = 0.0;
#pragma omp parallel for schedule(static, 1) num_threads(threads) reduction(+ : pairs)
  for (std::size_t p = 0; p < parts; ++p) {
    part[p].reserve(clusters / parts * 300);
    for (std::size_t n = clusters * p / parts; n < clusters * (p + 1) / parts; ++n) {
      const std::size_t before = part[p].size();
      pairs += list_cluster(c, cells, support * support, reach * reach, lists.first[n],
                            lists.first[n + 1] - lists.first[n], part[p]);
      lists.start[n + 1] = part[p].size() - before;
    }
  }
  for (std::size_t n = 0; n < clusters; ++n) lists.start[n + 1] += lists.start[n];
  lists.partner.resize(lists.start.back());
  for (std::size_t p = 0, at = 0; p < parts; at += part[p].size(), ++p)
    std::ranges::copy(part[p], lists.partner.begin() + static_cast<std::ptrdiff_t>(at));
  lists.pairs = pairs;
}

}  // namespace

template <>
LaneLoops lane_loops<Unit>() {
  return {L,
          &list,
          &sweep<SeedDensity>,
          &sweep<SeedRates>,
          &sweep<CorrectedDensity>,
          &sweep<CorrectedRates>,
          &sweep<CorrectedHeat>};
}

}  // namespace tripoint::bench
