// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/overlap.hpp"
#include "scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tripoint {
namespace {

using Cell = std::array<long, 3>;

/// Particles sorted by cells of one `near` or somewhat more; periodic directions hold a whole number of
/// cells.
class Cells {
 public:
  Cells(const Scene& s, const InitialState& state, double near) : scene_(s) {
    for (std::size_t a = 0; a < 3; ++a) {
      side_[a] = near;
      if (!s.periodic[a]) continue;
      const double length = (*s.max)[a] - (*s.min)[a];
      number_[a] = std::max(1L, static_cast<long>(length / near));
      side_[a] = length / static_cast<double>(number_[a]);
    }
    sorted_.reserve(state.size());
    for (std::size_t i = 0; i < state.size(); ++i) sorted_.push_back({wrapped(cell(state.position[i])), i});
    std::sort(sorted_.begin(), sorted_.end());
  }

  [[nodiscard]] Cell cell(const Vec3& r) const {
    Cell c{};
    for (std::size_t a = 0; a < 3; ++a)
      c[a] = static_cast<long>(std::floor((r[a] - (scene_.min ? (*scene_.min)[a] : 0.0)) / side_[a]));
    return c;
  }

  /// Calls f(i) for the particles of the cell and its 26 neighbours, each cell once.
  template <class F>
  void around(const Cell& c, F f) const {
    std::vector<Cell> cells;
    for (long x = -1; x <= 1; ++x)
      for (long y = -1; y <= 1; ++y)
        for (long z = -1; z <= 1; ++z) cells.push_back(wrapped({c[0] + x, c[1] + y, c[2] + z}));
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    for (const auto& n : cells)
      for (auto it = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair<Cell, std::size_t>{n, 0});
           it != sorted_.end() && it->first == n; ++it)
        f(it->second);
  }

 private:
  [[nodiscard]] Cell wrapped(Cell c) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (number_[a] > 0) c[a] = (c[a] % number_[a] + number_[a]) % number_[a];
    return c;
  }

  const Scene& scene_;
  std::array<double, 3> side_{};
  std::array<long, 3> number_{};  ///< 0 = open
  std::vector<std::pair<Cell, std::size_t>> sorted_;
};

double distance(const Scene& s, Vec3 d) {
  for (std::size_t a = 0; a < 3; ++a)
    if (s.periodic[a]) d[a] -= ((*s.max)[a] - (*s.min)[a]) * std::round(d[a] / ((*s.max)[a] - (*s.min)[a]));
  return norm(d);
}

}  // namespace

std::vector<Overlap> find_overlaps(const Scene& s, const InitialState& state, double near) {
  if (s.bodies.size() < 2) return {};
  const Cells cells(s, state, near);
  std::map<std::pair<int, int>, Overlap> found;
  for (std::size_t i = 0; i < state.size(); ++i)
    cells.around(cells.cell(state.position[i]), [&](std::size_t j) {
      if (state.source[j] <= state.source[i]) return;  // each pair once
      const double r = distance(s, state.position[i] - state.position[j]);
      if (!(r < near)) return;
      auto& o = found
                    .try_emplace({state.source[i], state.source[j]},
                                 Overlap{static_cast<std::size_t>(state.source[i]),
                                         static_cast<std::size_t>(state.source[j]),
                                         0,
                                         INFINITY,
                                         {}})
                    .first->second;
      ++o.pairs;
      if (r < o.nearest) o.difference = state.position[i] - state.position[j];
      o.nearest = std::min(o.nearest, r);
    });
  std::vector<Overlap> out;
  for (const auto& [pair, o] : found) out.push_back(o);
  return out;
}

}  // namespace tripoint
