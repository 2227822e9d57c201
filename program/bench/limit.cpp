// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/limit.hpp"

#include <algorithm>
#include <ctime>

#include "core/lanes.hpp"
#include "core/machine.hpp"
#include "program/bench/clock.hpp"

namespace tripoint::bench {
namespace {

/// Runs a part some times. @param least kept where it is less than each   @param mean,mean_cpu of them all
template <class Part>
void time_part(int times, double& least, double& mean, double& mean_cpu, Part part) {
  const std::clock_t cpu = std::clock();
  double sum = 0.0;
  for (int n = 0; n < times; ++n) {
    const auto begin = Clock::now();
    part();
    const double took = since(begin);
    least = std::min(least, took);
    sum += took;
  }
  mean = sum / times;
  mean_cpu = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / times;
}

std::vector<double> steps_of(const std::vector<LimitSeconds>& rounds, std::span<const double> rebuilds) {
  std::vector<double> list;
  for (std::size_t k = 0; k < rounds.size(); ++k) list.push_back(rounds[k].step(rebuilds[k]));
  return list;
}

/// A number in [0.9, 1.1) that differs from row to row: loops over equal values could be cheaper.
double uneven(std::size_t row, std::size_t column) {
  return 0.9 + 0.2 * static_cast<double>((row * 2654435761u + column * 40503u) % 1024u) / 1024.0;
}

LaneCells cells_over(const LaneColumns& c, double reach) {
  constexpr double finer[3] = {4.0, 1.0, 1.0};
  LaneCells cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] =
        std::minmax_element(c.of[a].begin(), c.of[a].begin() + static_cast<std::ptrdiff_t>(c.rows));
    cells.low[a] = *low;
    cells.per_width[a] = finer[a] / reach;
    cells.count[a] = static_cast<int>((*high - *low) * cells.per_width[a]) + 1;
  }
  return cells;
}

}  // namespace

std::vector<LaneLoops> all_lane_loops() {
  std::vector<LaneLoops> list{lane_loops<Any>()};
  if (machine_has_avx2()) list.push_back(lane_loops<Avx2>());
  if (machine_has_avx512()) list.push_back(lane_loops<Avx512>());
  return list;
}

Limit::Limit(std::span<const Vec3> positions, Mode mode, double support, double skin, int threads)
    : mode_(mode), support_(support), reach_(support + skin), threads_(threads) {
  const std::size_t n = positions.size(), padded = n + vector_bytes / sizeof(double);
  start_.rows = n;
  for (std::size_t k = 0; k < LaneColumns::count; ++k) {
    auto& column = start_.of[k];
    column.assign(padded, 0.0);
    for (std::size_t i = 0; i < n; ++i) column[i] = k < 3 ? positions[i][k] : uneven(i, k);
  }
  for (auto& sum : start_.sum) sum.assign(padded, 0.0);
  columns_ = start_;
  for (const LaneLoops& loops : all_lane_loops()) {
    const LimitSeconds never{loops.lanes, 1e300, 1e300, 1e300, mode == Mode::paper ? 0.0 : 1e300};
    runners_.push_back({loops, {}, never, {}, {}});
  }
}

/// Stable counting sort by cell.
void Limit::sort() {
  const std::size_t n = start_.rows;
  cells_ = cells_over(start_, reach_);
  std::vector<std::uint32_t> cell(n), order(n);
  cells_.first.assign(static_cast<std::size_t>(cells_.count[0]) * static_cast<std::size_t>(cells_.count[1]) *
                              static_cast<std::size_t>(cells_.count[2]) +
                          1,
                      0);
  const double *x = start_.of[0].data(), *y = start_.of[1].data(), *z = start_.of[2].data();
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < n; ++i) {
    const auto place = [&](double r, std::size_t a) {
      return static_cast<int>((r - cells_.low[a]) * cells_.per_width[a]);
    };
    cell[i] = static_cast<std::uint32_t>(
        place(x[i], 0) + cells_.count[0] * (place(y[i], 1) + cells_.count[1] * place(z[i], 2)));
  }
  for (const std::uint32_t k : cell) ++cells_.first[k + 1];
  for (std::size_t k = 0; k + 1 < cells_.first.size(); ++k) cells_.first[k + 1] += cells_.first[k];
  std::vector<std::uint32_t> next(cells_.first.begin(), cells_.first.end() - 1);
  for (std::uint32_t i = 0; i < n; ++i) order[next[cell[i]]++] = i;
  const std::size_t used =
      mode_ == Mode::paper ? static_cast<std::size_t>(LaneColumns::viscosity) : LaneColumns::count;
  columns_.rows = n;
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t k = 0; k < used; ++k)
    for (std::size_t i = 0; i < n; ++i) columns_.of[k][i] = start_.of[k][order[i]];
}

void Limit::search(Runner& r) {
  sort();
  r.loops.list(columns_, cells_, support_, reach_, threads_, r.lists);
}

void Limit::round() {
  constexpr int times = 4;
  for (Runner& r : runners_) {
    if (r.loops.lanes == 1 && runners_.size() > 1) continue;  // never the least where there are vectors
    const bool seed = mode_ == Mode::paper;
    LimitSeconds mean{r.loops.lanes}, cpu = mean;
    const auto loop = [&](LaneLoops::Loop run, double LimitSeconds::*part) {
      time_part(times, r.least.*part, mean.*part, cpu.*part,
                [&] { run(columns_, r.lists, support_, threads_); });
    };
    if (first_) search(r);
    time_part(1, r.least.search, mean.search, cpu.search, [&] { search(r); });
    loop(seed ? r.loops.seed_density : r.loops.corrected_density, &LimitSeconds::density);
    loop(seed ? r.loops.seed_rates : r.loops.corrected_rates, &LimitSeconds::rates);
    if (!seed) loop(r.loops.corrected_heat, &LimitSeconds::again);
    r.rounds.push_back(mean);
    r.rounds_cpu.push_back(cpu);
    pairs_ = r.lists.pairs;
  }
  first_ = false;
}

std::vector<double> Limit::density(std::size_t unit) {
  Runner& r = runners_[unit];
  search(r);
  (mode_ == Mode::paper ? r.loops.seed_density : r.loops.corrected_density)(columns_, r.lists, support_,
                                                                            threads_);
  return {columns_.sum[0].begin(), columns_.sum[0].begin() + static_cast<std::ptrdiff_t>(columns_.rows)};
}

std::vector<double> Limit::sums(std::size_t unit) {
  Runner& r = runners_[unit];
  search(r);
  (mode_ == Mode::paper ? r.loops.seed_rates : r.loops.corrected_rates)(columns_, r.lists, support_,
                                                                        threads_);
  std::vector<double> all;
  for (std::size_t k = 0; k < 4; ++k)
    all.insert(all.end(), columns_.sum[k].begin(),
               columns_.sum[k].begin() + static_cast<std::ptrdiff_t>(columns_.rows));
  return all;
}

const Limit::Runner& Limit::fastest(double rebuilds) const {
  return *std::ranges::min_element(runners_, {}, [&](const Runner& r) { return r.least.step(rebuilds); });
}

LimitSeconds Limit::best(double rebuilds) const { return fastest(rebuilds).least; }

std::vector<double> Limit::steps(double rebuilds, std::span<const double> of_rounds) const {
  return steps_of(fastest(rebuilds).rounds, of_rounds);
}
std::vector<double> Limit::steps_cpu(double rebuilds, std::span<const double> of_rounds) const {
  return steps_of(fastest(rebuilds).rounds_cpu, of_rounds);
}

}  // namespace tripoint::bench
