// SPDX-License-Identifier: BSD-3-Clause
#include "program/bench/measure.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <ctime>
#include <numeric>

#include "assembly/plan.hpp"
#include "program/bench/clock.hpp"
#include "program/bench/memory.hpp"
#include "step/simulation.hpp"

namespace tripoint::bench {
namespace {

double cpu_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void run_steps(Simulation& simulation, long steps) {
  long left = steps;
  simulation.advance_to(simulation.state().scene.end_time * 1e3, [&] { return --left > 0; });
}

long rebuilds_of(const Simulation& s) { return s.state().neighbours ? s.state().neighbours->rebuilds() : 0; }

std::vector<Vec3> places(const Simulation& s) {
  const auto x = positions(s.state().particles);
  std::vector<Vec3> list(s.state().particles.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = x.at(i);
  return list;
}

/// FNV-1a over places and velocities in order of id.
std::string hash_of(const Simulation& s) {
  const Particles& p = s.state().particles;
  std::uint64_t hash = 1469598103934665603ULL;
  const auto x = positions(p), v = velocities(p);
  for (std::size_t id = 0; id < p.size(); ++id) {
    for (const Vec3& a : {x.at(p.row(id)), v.at(p.row(id))}) {
      for (std::size_t k = 0; k < 3; ++k)
        hash = (hash ^ std::bit_cast<std::uint64_t>(a[k])) * 1099511628211ULL;
    }
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t above = values.size() / 2, below = (values.size() - 1) / 2;
  return {0.5 * (values[below] + values[above]), values.front(), values.back()};
}

double Measured::search_share() const {
  const double all = std::accumulate(stages.begin(), stages.end(), outside);
  return all > 0.0 ? stages[static_cast<std::size_t>(Stage::search)] / all : 0.0;
}

Measured measure(const Work& work, const MeasureOptions& options) {
  const Start start = prepare(work);
  Measured m;
  m.particles = start.particles.size();
  m.threads = options.threads;
  m.planned_bytes = static_cast<double>(plan(start.scene).bytes_per_particle);

  restart_peak();
  const double before = resident_bytes();
  StageSeconds stages{};
  SimulationOptions how;
  how.threads = options.threads;
  how.stage_seconds = &stages;
  const auto begin = Clock::now();
  Simulation simulation(start.scene, start.particles, how);
  m.setup_seconds = since(begin);
  run_steps(simulation, work.warm);
  m.bytes = peak_bytes() - before;

  std::optional<Limit> limit;
  const double support = simulation.state().support();
  if (work.has_limit)
    limit.emplace(places(simulation), work.mode, support, how.skin * support, options.threads);
  const long each = std::max(1L, options.steps.value_or(work.steps) / options.rounds);
  std::vector<double> seconds, cpu, rebuilds;
  stages = {};
  for (int round = 0; round < options.rounds; ++round) {
    const auto from = Clock::now();
    const double cpu_from = cpu_now();
    const long lists = rebuilds_of(simulation);
    run_steps(simulation, each);
    seconds.push_back(since(from) / static_cast<double>(each));
    cpu.push_back((cpu_now() - cpu_from) / static_cast<double>(each));
    rebuilds.push_back(static_cast<double>(rebuilds_of(simulation) - lists) / static_cast<double>(each));
    m.steps += each;
    if (limit) limit->round();
  }
  const auto steps = static_cast<double>(m.steps);
  m.rebuilds = std::accumulate(rebuilds.begin(), rebuilds.end(), 0.0) / static_cast<double>(rebuilds.size());
  m.step_seconds = spread_of(seconds);
  m.cpu_seconds = spread_of(cpu);
  for (std::size_t k = 0; k < stages.size(); ++k) m.stages[k] = stages[k] / steps;
  m.outside = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size()) -
              std::accumulate(m.stages.begin(), m.stages.end(), 0.0);
  m.time_step = simulation.time_step();
  m.support = support;
  m.bonds = static_cast<double>(simulation.state().bonds.pairs());
  m.state_hash = hash_of(simulation);
  if (limit) {
    m.limit = limit->best(m.rebuilds);
    m.pairs = limit->pairs();
    const std::vector<double> of_limit = limit->steps(m.rebuilds, rebuilds),
                              cpu_of_limit = limit->steps_cpu(m.rebuilds, rebuilds);
    m.limit_cpu = spread_of(cpu_of_limit).median;
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      seconds[k] /= of_limit[k];
      cpu[k] /= cpu_of_limit[k];
    }
    m.over_limit = spread_of(seconds);
    m.over_limit_cpu = spread_of(cpu);
  }
  return m;
}

}  // namespace tripoint::bench
