// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/run_pass.hpp"

#include <cassert>

namespace tripoint {
namespace {

PassTask task_of(const Particles& particles, Neighbours& neighbours, const PairKernels& kernels,
                 int threads) {
  const auto x = positions(particles);
  Clusters& c = neighbours.clusters();
  const double support = neighbours.support();
  return {.x = x.x.data(),
          .y = x.y.data(),
          .z = x.z.data(),
          .first = c.first.data(),
          .start = c.start.data(),
          .entries = c.entries.data(),
          .near = c.near.data(),
          .own = c.own.empty() ? nullptr : c.own.data(),
          .within = c.within.empty() ? nullptr : c.within.data(),
          .shift = neighbours.shifts().data(),
          .count = c.size(),
          .support2 = support * support,
          .kernels = &kernels,
          .threads = threads};
}

std::vector<double*> columns_of(const PassFunction& function, Particles& particles) {
  std::vector<double*> columns;
  for (const Field<double>* f : function.fields) columns.push_back(particles[*f].data());
  return columns;
}

}  // namespace

void run_pass(const PassFunction& function, Particles& particles, Neighbours& neighbours,
              const PairKernels& kernels, int threads) {
  if (!function.run) return;
  if (function.finds) neighbours.make_room_within();
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data();
  if (const auto& visits = neighbours.clusters().visits; !visits.empty()) task.chosen = visits.data();
  function.run(task);
}

void run_pass_among(const PassFunction& function, Particles& particles, Neighbours& neighbours,
                    const PairKernels& kernels, int threads, const std::vector<std::uint64_t>& entries) {
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data();
  task.within = nullptr;
  task.only = entries.data();
  function.run(task);
}

void run_pass_in(const PassFunction& function, Particles& particles, Neighbours& neighbours,
                 const PairKernels& kernels, int threads, const std::optional<ChosenClusters>& chosen) {
  if (!chosen) return run_pass(function, particles, neighbours, kernels, threads);
  if (!function.run || chosen->clusters.empty()) return;
  if (function.finds) neighbours.make_room_within();
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data();
  task.chosen = chosen->clusters.data();
  task.count = chosen->clusters.size();
  function.run(task);
}

void run_pass_over(const PassFunction& function, Particles& particles, Neighbours& neighbours,
                   const PairKernels& kernels, int threads, const ChosenClusters& chosen) {
  if (function.run)
    run_pass_over(function, columns_of(function, particles), particles, neighbours, kernels, threads, chosen);
}

void run_pass_over(const PassFunction& function, const std::vector<double*>& columns,
                   const Particles& particles, Neighbours& neighbours, const PairKernels& kernels,
                   int threads, const ChosenClusters& chosen) {
  if (chosen.clusters.empty()) return;
  PassTask task = task_of(particles, neighbours, kernels, threads);
  task.columns = columns.data();
  task.chosen = chosen.clusters.data();
  task.count = chosen.clusters.size();
  if (!chosen.members.empty()) task.members = chosen.members.data();
  if (!function.finds && !neighbours.clusters().acting.empty())
    task.only = neighbours.clusters().acting.data();
  function.run(task);
}

ChosenClusters clusters_of(const Clusters& c, const std::vector<std::uint32_t>& rows) {
  ChosenClusters chosen;
  for (const std::uint32_t row : rows) {
    const std::uint32_t cluster = c.of(row);
    assert(chosen.clusters.empty() || chosen.clusters.back() <= cluster);
    if (chosen.clusters.empty() || chosen.clusters.back() != cluster) {
      chosen.clusters.push_back(cluster);
      chosen.members.push_back(0);
    }
    chosen.members.back() = static_cast<std::uint8_t>(chosen.members.back() | 1u << (row - c.first[cluster]));
  }
  return chosen;
}

}  // namespace tripoint
