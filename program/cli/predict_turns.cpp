// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/predict_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "program/cli/common.hpp"

namespace tripoint {
namespace {

constexpr double coarser = 2.0, wider = 1.25;
constexpr double share_of_memory = 0.8;  ///< that runs at once may take of what is free

void prepare_one_rank(PredictRuns& engine, RunsInTurns& runs, std::vector<std::string>& notes) {
  runs.one_rank.push_back(engine.prepare("case", {}));
  engine.choose_end(runs.one_rank.front());
  const Scene scene = runs.one_rank.front().scene;
  const std::vector<std::pair<std::string, std::string>> others{
      {"coarse", fmt::format("scene.spacing={:.17g}", coarser * scene.spacing)},
      {"wide", fmt::format("scene.support_ratio={:.17g}", wider * scene.support_ratio)}};
  for (const auto& [label, set] : others) {
    if (interrupted()) return;
    try {
      Prepared p = engine.prepare(label, {set});
      engine.choose_end(p, runs.one_rank.front().end);
      runs.one_rank.push_back(std::move(p));
    } catch (const std::exception& e) {
      notes.push_back(fmt::format("no run with {}: {}", set, e.what()));
    }
  }
}

/// Keys of a scene with finer particles, of which each rank has as many as one has of the scene as it is. A time step that the
/// scene fixes becomes finer too, so that particles pass as much of a spacing in a step and lists last as long.
std::vector<std::string> finer(const Scene& scene, int ranks) {
  const double by = 1.0 / std::cbrt(ranks);
  std::vector<std::string> set{fmt::format("scene.spacing={:.17g}", scene.spacing * by)};
  if (scene.time_step) set.push_back(fmt::format("scene.time_step={:.17g}", *scene.time_step * by));
  return set;
}

void prepare_larger(PredictRuns& engine, const TurnsWanted& wanted, RunsInTurns& runs) {
  if (!wanted.weak) return;
  const Prepared& base = runs.one_rank.front();
  for (const int ranks : wanted.measure.empty() ? wanted.ranks : wanted.measure) {
    if (ranks == 1 || interrupted()) continue;
    Prepared p = engine.prepare(fmt::format("weak-{}", ranks), wanted.larger.empty() ? finer(base.scene, ranks) : wanted.larger);
    p.cloud.reach = base.cloud.reach * p.scene.spacing / base.scene.spacing;
    if (!wanted.measure.empty()) engine.choose_end(p, base.end);
    runs.larger.emplace(ranks, std::move(p));
  }
}

/// [bytes] that programs can still take; infinity where the system does not say.
double free_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string word; in >> word;) {
    double kib = 0.0;
    if (word == "MemAvailable:" && in >> kib) return 1024.0 * kib;
  }
  return std::numeric_limits<double>::infinity();
}

/// How many runs of one rank go at once: as many as a node has ranks, for each number of ranks that is asked for.
std::set<int> numbers_at_once(const TurnsWanted& wanted, double bytes_of_a_run, std::vector<std::string>& notes) {
  std::set<int> counts;
  for (const std::vector<int>* list : {&wanted.ranks, &wanted.measure})
    for (const int ranks : *list) counts.insert(std::min(ranks, wanted.cores));
  counts.erase(1);
  const double room = share_of_memory * free_memory();
  while (!counts.empty() && *counts.rbegin() * bytes_of_a_run > room) {
    notes.push_back(
        fmt::format("{} runs of one rank at once would take {:.3g} GB, and {:.3g} are free: what cores lose where so "
                    "many have work is not measured",
                    *counts.rbegin(), 1e-9 * *counts.rbegin() * bytes_of_a_run, 1e-9 * room));
    counts.erase(std::prev(counts.end()));
  }
  return counts;
}

}  // namespace

RunsInTurns run_in_turns(PredictRuns& engine, const TurnsWanted& wanted, std::vector<std::string>& notes) {
  RunsInTurns runs;
  prepare_one_rank(engine, runs, notes);
  prepare_larger(engine, wanted, runs);
  runs.one_rank_timed.resize(runs.one_rank.size());
  for (const int ranks : wanted.measure) {
    if (ranks == 1) continue;
    runs.strong[ranks].ranks = ranks;
    if (wanted.weak) runs.weak[ranks].ranks = ranks;
  }
  const Prepared& base = runs.one_rank.front();
  for (int n = 0; n < wanted.repeats; ++n) {
    for (std::size_t k = 0; k < runs.one_rank.size() && !interrupted(); ++k)
      engine.time(runs.one_rank[k], runs.one_rank_timed[k]);
    if (n == 0 && !interrupted())
      for (const int count : numbers_at_once(wanted, runs.alone().bytes, notes)) runs.at_once[count];
    for (auto& [count, timed] : runs.at_once)
      if (!interrupted()) engine.time_at_once(base, count, timed, runs.one_rank_timed.front());
    for (auto& [ranks, timed] : runs.strong)
      if (!interrupted()) engine.time(base, timed);
    for (auto& [ranks, timed] : runs.weak)
      if (!interrupted()) engine.time(runs.larger.at(ranks), timed);
  }
  return runs;
}

}  // namespace tripoint
