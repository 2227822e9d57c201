// SPDX-License-Identifier: BSD-3-Clause
#include "program/predict/cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/errors.hpp"

namespace tripoint::predict {
namespace {

using Row = std::array<double, 3>;

constexpr double head_of_a_number = sizeof(double);
constexpr double atom_numbers = 6.0;  ///< place, id, type and mask, which LAMMPS sends with a new copy

/// Solves the normal equations of the chosen terms by Gauss with pivots. @param of_first weight of the first
/// row; others have 1
/// @return nothing where they do not tell the terms apart
std::optional<Row> least_squares(const std::vector<Row>& rows, const std::vector<std::size_t>& terms,
                                 double of_first) {
  const std::size_t n = terms.size();
  std::array<std::array<double, 4>, 3> m{};
  for (const Row& row : rows) {
    const double weight = &row == &rows.front() ? of_first : 1.0;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) m[a][b] += weight * row[terms[a]] * row[terms[b]];
      m[a][3] += weight * row[terms[a]];
    }
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(m[r][c]) > std::abs(m[pivot][c])) pivot = r;
    std::swap(m[c], m[pivot]);
    if (!(std::abs(m[c][c]) > 0.0)) return std::nullopt;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = m[r][c] / m[c][c];
      for (std::size_t k = 0; k < 4; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  Row found{};
  for (std::size_t c = 0; c < n; ++c) found[terms[c]] = m[c][3] / m[c][c];
  return found;
}

}  // namespace

/// Terms are scaled by their values in the greatest run, and each run by its time: the fitted value is 1 in
/// each run. The first run is of the case itself and counts most: predictions are nearest to it, also in the
/// effect of caches.
WorkCost fit_work(const std::vector<OneRank>& runs) {
  if (runs.empty()) throw InputError("no run on one rank to fit the cost of a step to");
  for (const OneRank& r : runs)
    if (!(r.particles > 0.0 && r.pairs > 0.0 && r.seconds > 0.0))
      throw InputError("a run on one rank gave no time of a step");
  const OneRank& most = *std::max_element(
      runs.begin(), runs.end(), [](const OneRank& a, const OneRank& b) { return a.pairs < b.pairs; });
  const Row scale{most.seconds, most.seconds / most.particles, most.seconds / most.pairs};
  constexpr double weight_of_case = 10.0;
  std::vector<Row> rows;
  for (const OneRank& r : runs)
    rows.push_back(
        {scale[0] / r.seconds, scale[1] * r.particles / r.seconds, scale[2] * r.pairs / r.seconds});
  // A step consists mainly of pairs, so that they are never left out. Fewer terms go first where they do as
  // well, and particles before fixed costs. Runs of one number of particles do not tell these two apart.
  const std::array<std::vector<std::size_t>, 4> choices{{{2}, {1, 2}, {0, 2}, {0, 1, 2}}};
  constexpr double better = 1e-9;
  WorkCost best;
  double least = INFINITY;
  for (const auto& terms : choices) {
    if (terms.size() > rows.size()) continue;
    const auto found = least_squares(rows, terms, weight_of_case);
    if (!found || std::any_of(found->begin(), found->end(), [](double c) { return !(c >= 0.0); })) continue;
    double sum = 0.0, worst = 0.0;
    for (const Row& row : rows) {
      const double off = std::inner_product(row.begin(), row.end(), found->begin(), -1.0);
      sum += (&row == &rows.front() ? weight_of_case : 1.0) * off * off;
      worst = std::max(worst, std::abs(off));
    }
    if (!(sum < least - better)) continue;
    least = sum;
    best = {(*found)[0] * scale[0], (*found)[1] * scale[1], (*found)[2] * scale[2], worst};
  }
  return best;
}

Memory fit_memory(const std::vector<OneRank>& runs, double scene_bytes) {
  if (runs.empty()) throw InputError("no run on one rank to fit memory to");
  const auto [least, most] = std::minmax_element(
      runs.begin(), runs.end(), [](const OneRank& a, const OneRank& b) { return a.particles < b.particles; });
  const double apart = most->particles - least->particles;
  const double slope = apart > 0.0 ? (most->bytes - least->bytes) / apart : most->bytes / most->particles;
  Memory m;
  m.scene = std::clamp(scene_bytes, 0.0, std::max(slope, 0.0));
  m.particle = std::max(slope, 0.0) - m.scene;
  m.base = std::max(0.0, most->bytes - std::max(slope, 0.0) * most->particles);
  return m;
}

Prediction predict(const Shares& shares, const Share& whole, const WorkCost& cost, const Memory& memory,
                   const Traffic& traffic, const Machine& machine, double speed_at_once) {
  Prediction p;
  p.ranks = static_cast<int>(shares.ranks.size());
  if (p.ranks > 1) p.speed_at_once = speed_at_once;
  p.particles = whole.own;
  const auto count = static_cast<double>(p.ranks);
  double sum = 0.0, most_copies = 0.0, most_held = 0.0;
  for (const Share& s : shares.ranks) {
    const double seconds = cost.seconds(s.own + s.copies, s.worked) / (machine.core_speed * p.speed_at_once);
    p.work = std::max(p.work, seconds);
    sum += seconds;
    p.own += s.own / count;
    p.copies += s.copies / count;
    most_copies = std::max(most_copies, s.copies);
    most_held = std::max(most_held, s.own + s.copies);
  }
  p.imbalance = p.work * count / sum;
  if (p.ranks > 1) {
    const double bytes = most_copies * head_of_a_number *
                         (traffic.numbers_a_copy + traffic.migrations * (traffic.columns + atom_numbers));
    p.messages = (traffic.exchanges + traffic.migrations) * shares.messages * machine.latency;
    p.transport = bytes * (1.0 / machine.bandwidth + 2.0 / machine.pack_rate);
    p.collectives = traffic.collectives * std::ceil(std::log2(count)) * machine.allreduce;
    p.waiting = machine.waiting * p.work;
  }
  p.efficiency = cost.seconds(whole.own, whole.worked) / machine.core_speed / (count * p.seconds());
  p.scene_bytes = memory.scene * whole.own;
  p.bytes = memory.bytes(whole.own, most_held);
  return p;
}

}  // namespace tripoint::predict
