// SPDX-License-Identifier: BSD-3-Clause
#include "effects/run_pass.hpp"

#include <cassert>

#include "core/defect.hpp"

namespace tripoint {
namespace {

PassTask task_of(const Particles& particles, Neighbours& neighbours, const PairKernels& kernels, int threads) {
  const auto x = positions(particles);
  Clusters& c = neighbours.clusters();
  static const double nearer = 1.0 - defect_size("neighbours.support");
  const double support = nearer * neighbours.support();
  return {x.x.data(), x.y.data(), x.z.data(), nullptr, c.first.data(), c.start.data(), c.entries.data(), c.near.data(), c.own.empty() ? nullptr : c.own.data(),
          c.within.empty() ? nullptr : c.within.data(), neighbours.shifts().data(), nullptr, nullptr, c.size(), support * support, &kernels, threads};
}

std::vector<double*> columns_of(const PassFunction& function, Particles& particles) {
  std::vector<double*> columns;
  for (const Field<double>* f : function.fields) columns.push_back(particles[*f].data());
  return columns;
}

}  // namespace

void run_pass(const PassFunction& function, Particles& particles, Neighbours& neighbours, const PairKernels& kernels, int threads) {
  if (!function.run) return;
  if (function.finds) neighbours.make_room_within();
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data();
  function.run(task);
}

void run_pass_over(const PassFunction& function, Particles& particles, Neighbours& neighbours, const PairKernels& kernels, int threads, const std::vector<std::uint32_t>& clusters) {
  if (!function.run || clusters.empty()) return;
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data(), task.chosen = clusters.data(), task.count = clusters.size();
  function.run(task);
}

void run_pass(const PassFunction& function, Particles& particles, Neighbours& neighbours, const PairKernels& kernels, int threads,
              const std::vector<std::uint32_t>& rows) {
  if (!function.run || rows.empty()) return;
  const Clusters& c = neighbours.clusters();
  std::vector<std::uint32_t> chosen;
  std::vector<std::uint8_t> members;
  for (const std::uint32_t row : rows) {
    const std::uint32_t cluster = c.of(row);
    assert(chosen.empty() || chosen.back() <= cluster);
    if (chosen.empty() || chosen.back() != cluster) chosen.push_back(cluster), members.push_back(0);
    members.back() = static_cast<std::uint8_t>(members.back() | 1u << (row - c.first[cluster]));
  }
  PassTask task = task_of(particles, neighbours, kernels, threads);
  const std::vector<double*> columns = columns_of(function, particles);
  task.columns = columns.data(), task.chosen = chosen.data(), task.members = members.data(), task.count = chosen.size();
  if (function.finds) task.within = nullptr;  // of some clusters alone it is of no use
  function.run(task);
}

}  // namespace tripoint
