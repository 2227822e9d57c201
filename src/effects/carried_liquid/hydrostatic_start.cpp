// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/hydrostatic_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "liquids/pressing_gravity.hpp"

namespace tripoint::carried_liquid {
namespace {

constexpr double gap = 1.6;  ///< beyond it two particles do not stand on each other [spacings]

enum class Known : char { not_pressed, covered, yes };

struct Start {
  const State& state;
  Vec3 g, down;
  double pull, dx;
  std::vector<double> pressure;
  std::vector<Known> known;

  [[nodiscard]] bool is_wall(std::size_t i) const { return state.particles[field::group][i] == wall_group; }
  [[nodiscard]] bool is_liquid(std::size_t i) const { return state.particles[field::body][i] < 0; }
  [[nodiscard]] double density(std::size_t i) const { return state.material_of(i).density; }
};

/// Particles one above the other: depth along gravity, and row.
using Column = std::vector<std::pair<double, std::size_t>>;

std::vector<Column> columns_of(const Start& s) {
  const Vec3 other = std::abs(s.down.x) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 a = (1.0 / norm(cross(s.down, other))) * cross(s.down, other), b = cross(s.down, a);
  const Vec3 origin = s.state.particles.position(0);
  std::map<std::pair<long, long>, Column> columns;
  for (std::size_t i = 0; i < s.state.particles.size(); ++i) {
    const Vec3 r = s.state.particles.position(i) - origin;
    const auto bin = [&](const Vec3& e) { return std::lround(dot(r, e) / s.dx); };
    columns[{bin(a), bin(b)}].emplace_back(dot(r, s.down), i);
  }
  std::vector<Column> list;
  for (auto& [at, column] : columns) {
    std::ranges::sort(column);
    list.push_back(std::move(column));
  }
  return list;
}

/// A stretch of a column that stands on a wall: each particle bears what lies above it. Liquid beneath a
/// solid is covered.
void press(Start& s, std::span<const std::pair<double, std::size_t>> stretch) {
  double p = 0.0;
  bool open = true;
  for (std::size_t n = 0; n < stretch.size(); ++n) {
    const std::size_t i = stretch[n].second;
    open = open && s.is_liquid(i);
    const double above = n == 0 ? s.dx : stretch[n].first - stretch[n - 1].first;
    const double rho_above = n == 0 ? 0.0 : s.density(stretch[n - 1].second);
    p += 0.5 * s.pull * (s.density(i) + rho_above) * above;
    s.pressure[i] = p;
    s.known[i] = open ? Known::yes : Known::covered;
  }
}

void press_columns(Start& s) {
  for (const Column& list : columns_of(s))
    for (std::size_t from = 0, past = 0; from < list.size(); from = past) {
      past = from + 1;
      while (past < list.size() && !s.is_wall(list[past - 1].second) &&
             list[past].first - list[past - 1].first < gap * s.dx)
        ++past;
      if (s.is_wall(list[past - 1].second)) press(s, std::span(list).subspan(from, past - 1 - from));
    }
}

/// Liquids by cells as wide as the gap.
class Cells {
 public:
  explicit Cells(const Start& s) : s_(s) {
    for (std::size_t i = 0; i < s.state.particles.size(); ++i)
      if (s.is_liquid(i) && s.known[i] != Known::not_pressed) cells_[cell_of(i)].push_back(i);
  }
  template <class Visit>
  void each_near(std::size_t i, Visit visit) const {
    const auto at = cell_of(i);
    const Vec3 r = s_.state.particles.position(i);
    for (long n = 0; n < 27; ++n) {
      const auto cell = cells_.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (cell == cells_.end()) continue;
      for (const std::size_t j : cell->second)
        if (norm(s_.state.particles.position(j) - r) < gap * s_.dx) visit(j);
    }
  }

 private:
  [[nodiscard]] std::array<long, 3> cell_of(std::size_t i) const {
    const Vec3 r = s_.state.particles.position(i);
    const auto of = [&](double x) { return std::lround(std::floor(x / (gap * s_.dx))); };
    return {of(r.x), of(r.y), of(r.z)};
  }
  const Start& s_;
  std::map<std::array<long, 3>, std::vector<std::size_t>> cells_;
};

/// Covered liquid takes its pressure from open liquid beside it, a ring of particles after the other. What no
/// open liquid reaches bears the weight of the solid above it.
void spread_under_solids(Start& s) {
  const Cells cells(s);
  std::vector<std::size_t> covered;
  for (std::size_t i = 0; i < s.known.size(); ++i)
    if (s.is_liquid(i) && s.known[i] == Known::covered) covered.push_back(i);
  for (std::size_t before = 0; before != covered.size();) {
    before = covered.size();
    std::vector<std::pair<std::size_t, double>> reached;
    for (const std::size_t i : covered) {
      double sum = 0.0, count = 0.0;
      cells.each_near(i, [&](std::size_t j) {
        if (s.known[j] != Known::yes) return;
        const Vec3 d = s.state.particles.position(i) - s.state.particles.position(j);
        sum += s.pressure[j] + 0.5 * (s.density(i) + s.density(j)) * dot(s.g, d);
        count += 1.0;
      });
      if (count > 0.0) reached.emplace_back(i, std::max(sum / count, 0.0));
    }
    for (const auto& [i, p] : reached) {
      s.pressure[i] = p;
      s.known[i] = Known::yes;
    }
    std::erase_if(covered, [&](std::size_t i) { return s.known[i] == Known::yes; });
  }
}

}  // namespace

std::vector<double> hydrostatic_start(const State& state) {
  const std::size_t count = state.particles.size();
  const Vec3 g = liquid::pressing_gravity(state.scene);
  if (g == Vec3{} || count == 0) return std::vector<double>(count, 0.0);
  Start s{state,
          g,
          (1.0 / norm(g)) * g,
          norm(g),
          state.scene.spacing,
          std::vector<double>(count, 0.0),
          std::vector<Known>(count, Known::not_pressed)};
  press_columns(s);
  spread_under_solids(s);
  return s.pressure;
}

}  // namespace tripoint::carried_liquid
