// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/walker_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::lammps {

double Random::gaussian() {
  const double u = 1.0 - uniform();  // (0, 1]
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * uniform());
}

WalkerStart::WalkerStart(const Job& job, const InitialState& state, const CellBox& box)
    : scene_(job.scene), state_(state), box_(box) {
  Range all{INFINITY, -INFINITY};
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    if (scene_.bodies[b].temperature_held) continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < state.size(); ++i)
      if (state.source[i] == static_cast<int>(b)) values.push_back(state.temperature.at(i));
    const Range r = range_of(*scene_.bodies[b].temperature, values);
    all = {std::min(all.least, r.least), std::max(all.greatest, r.greatest)};
  }
  baseline_ = all.least;
  top_ = all.greatest - all.least;
  if (box.held_axis >= 0) {
    const double one = box.held_low.value_or(box.held_high.value_or(0.0)),
                 other = box.held_high.value_or(one);
    top_ =
        std::max(std::abs(all.greatest - std::min(one, other)), std::abs(all.least - std::max(one, other)));
  }
  if (!(top_ > 0.0)) throw EngineError("the temperature is uniform: there is nothing for walkers to carry");
  place_particles(state);
  weigh_cells();
}

void WalkerStart::place_particles(const InitialState& state) {
  const auto& n = box_.cells;
  particle_of_cell_.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2], -1);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (scene_.bodies[static_cast<std::size_t>(state.source[i])].temperature_held) {
      cell_of_particle_.push_back(-1);
      continue;
    }
    ++placed;
    std::array<int, 3> c{};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = std::clamp(static_cast<int>(std::floor((state.position[i][k] - box_.min[k]) / scene_.spacing)),
                        0, n[k] - 1);
    const int cell = c[0] + n[0] * (c[1] + n[1] * c[2]);
    if (particle_of_cell_[static_cast<std::size_t>(cell)] >= 0)
      throw EngineError("two particles lie in one cell of a spacing: walkers are counted on the lattice");
    particle_of_cell_[static_cast<std::size_t>(cell)] = static_cast<int>(i);
    cell_of_particle_.push_back(cell);
  }
  if (placed != particle_of_cell_.size())
    throw EngineError("a cell of the box holds no particle: walkers are counted on the lattice");
}

double WalkerStart::excess(int particle, const Vec3& cells) const {
  const auto i = static_cast<std::size_t>(particle);
  const Body& body = scene_.bodies[static_cast<std::size_t>(state_.source[i])];
  return value_at(*body.temperature, box_.min + scene_.spacing * cells).value_or(state_.temperature[i]) -
         base(cells);
}

double WalkerStart::excess_at(const Vec3& at) const {
  std::array<int, 3> c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = std::clamp(static_cast<int>(std::floor(at[k])), 0, box_.cells[k] - 1);
  return excess(
      particle_of_cell_[static_cast<std::size_t>(c[0] + box_.cells[0] * (c[1] + box_.cells[1] * c[2]))], at);
}

/// Between two held faces the straight line, beside one its temperature: the rest then vanishes at the held
/// faces.
double WalkerStart::base(const Vec3& cells) const {
  if (box_.held_axis < 0) return baseline_;
  const auto axis = static_cast<std::size_t>(box_.held_axis);
  const double low = box_.held_low.value_or(box_.held_high.value_or(0.0)),
               high = box_.held_high.value_or(low);
  return low + (high - low) * cells[axis] / box_.cells[axis];
}

/// Integral over each cell by three Gauss points a direction: exact to 1e-8 for a wave of ten cells.
void WalkerStart::weigh_cells() {
  const double a = std::sqrt(0.6) / 2.0;
  const std::array<double, 3> at{0.5 - a, 0.5, 0.5 + a}, share{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  double sum = 0.0;
  for (int cell = 0; cell < static_cast<int>(particle_of_cell_.size()); ++cell) {
    const Vec3 corner{double(cell % box_.cells[0]), double(cell / box_.cells[0] % box_.cells[1]),
                      double(cell / box_.cells[0] / box_.cells[1])};
    double mean = 0.0, size = 0.0;
    for (std::size_t p = 0; p < 27; ++p) {
      const double T = excess(particle_of_cell_[static_cast<std::size_t>(cell)],
                              corner + Vec3{at[p % 3], at[p / 3 % 3], at[p / 9]});
      const double part = share[p % 3] * share[p / 3 % 3] * share[p / 9];
      mean += part * T;
      size += part * std::abs(T);
    }
    mean_.push_back(mean);
    cumulative_.push_back(sum += size);
  }
}

/// A cell by its share, then a place within it by rejection under the field itself.
Vec3 WalkerStart::draw(Random& random) const {
  const auto found =
      std::upper_bound(cumulative_.begin(), cumulative_.end(), random.uniform() * cumulative_.back());
  const int cell = static_cast<int>(std::min<std::ptrdiff_t>(
      found - cumulative_.begin(), static_cast<std::ptrdiff_t>(cumulative_.size()) - 1));
  const Vec3 corner{double(cell % box_.cells[0]), double(cell / box_.cells[0] % box_.cells[1]),
                    double(cell / box_.cells[0] / box_.cells[1])};
  for (;;) {
    const Vec3 at = corner + Vec3{random.uniform(), random.uniform(), random.uniform()};
    if (random.uniform() * top_ < std::abs(excess(particle_of_cell_[static_cast<std::size_t>(cell)], at)))
      return at;
  }
}

int WalkerStart::only_axis() const {
  const auto depends = [&](std::size_t axis) {
    std::size_t stride = 1;
    for (std::size_t k = 0; k < axis; ++k) stride *= static_cast<std::size_t>(box_.cells[k]);
    for (std::size_t c = 0; c + stride < mean_.size(); ++c) {
      const bool neighbours = static_cast<int>(c / stride) % box_.cells[axis] + 1 < box_.cells[axis];
      if (neighbours && std::abs(mean_[c + stride] - mean_[c]) > 1e-9 * top_) return true;
    }
    return false;
  };
  int only = -1;
  for (std::size_t k = 0; k < 3; ++k)
    if (static_cast<int>(k) == box_.held_axis || depends(k)) {
      if (only >= 0) return -1;
      only = static_cast<int>(k);
    }
  return only;
}

}  // namespace tripoint::lammps
