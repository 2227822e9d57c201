// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/predict_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "program/bench/core_pace.hpp"
#include "program/cli/common.hpp"
#include "validation/results/interrupt.hpp"

namespace tripoint {
namespace {

constexpr double coarser = 2.0, wider = 1.25;
constexpr double share_of_memory = 0.8;  ///< that runs at once may take of what is free
constexpr double notable = 0.1;          ///< share of slow looks

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

/// Keys of a scene with finer particles, of which each rank has as many as one has of the scene as it is. A
/// time step that the scene fixes becomes finer too, so that particles pass as much of a spacing in a step
/// and lists last as long.
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
    Prepared p = engine.prepare(fmt::format("weak-{}", ranks),
                                wanted.larger.empty() ? finer(base.scene, ranks) : wanted.larger);
    p.cloud.reach = base.cloud.reach * p.scene.spacing / base.scene.spacing;
    if (!wanted.measure.empty()) engine.choose_end_as(p, base);
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

/// How many runs of one rank go at once: as many as a node has ranks, for each number of ranks that is asked
/// for.
std::set<int> numbers_at_once(const TurnsWanted& wanted, double bytes_of_a_run,
                              std::vector<std::string>& notes) {
  std::set<int> counts;
  for (const std::vector<int>* list : {&wanted.ranks, &wanted.measure})
    for (const int ranks : *list) counts.insert(std::min(ranks, wanted.cores));
  counts.erase(1);
  const double room = share_of_memory * free_memory();
  while (!counts.empty() && *counts.rbegin() * bytes_of_a_run > room) {
    notes.push_back(fmt::format(
        "{} runs of one rank at once would take {:.3g} GB, and {:.3g} are free: what cores lose where so "
        "many have work is not measured",
        *counts.rbegin(), 1e-9 * *counts.rbegin() * bytes_of_a_run, 1e-9 * room));
    counts.erase(std::prev(counts.end()));
  }
  return counts;
}

/// Best times of all that is timed [s], in one order.
std::vector<double> best_times(const RunsInTurns& runs) {
  std::vector<double> best;
  for (const Timed& t : runs.one_rank_timed) best.push_back(t.best.wall());
  for (const auto* timed : {&runs.at_once, &runs.strong, &runs.weak})
    for (const auto& entry : *timed) best.push_back(entry.second.best.wall());
  return best;
}

/// Makes the runs, each when the cores are fast or no more patience is left.
class Turns {
 public:
  Turns(PredictRuns& engine, const TurnsWanted& wanted, RunsInTurns& runs)
      : engine_(engine), wanted_(wanted), runs_(runs), pace_(wanted.cores) {}

  void make(std::vector<std::string>& notes) {
    predict::Settling settling;
    for (int n = 0; n < wanted_.most_repeats && !interrupted(); ++n) {
      one_turn(notes);
      if (interrupted()) break;
      runs_.went.repeats = n + 1;
      runs_.went.settled = settling.add(best_times(runs_));
      if (runs_.went.repeats >= wanted_.repeats && runs_.went.settled) break;
    }
    runs_.went.looks = pace_.looks();
    runs_.went.slow_looks = pace_.slow_looks();
  }

 private:
  template <class Run>
  void when_fast(const Run& run) {
    if (interrupted()) return;
    const double waited = pace_.wait_until_fast(wanted_.patience - runs_.went.waited, interrupted);
    runs_.went.waited += waited;
    if (waited > worth_saying && !wanted_.quiet)
      say(fmt::format("predict: waited {:.1f} s for cores that were slow", waited));
    if (!interrupted()) run();
  }

  void one_turn(std::vector<std::string>& notes) {
    const Prepared& base = runs_.one_rank.front();
    for (std::size_t k = 0; k < runs_.one_rank.size(); ++k)
      when_fast([&] { engine_.time(runs_.one_rank[k], runs_.one_rank_timed[k]); });
    if (runs_.went.repeats == 0 && !interrupted())
      for (const int count : numbers_at_once(wanted_, runs_.alone().bytes, notes)) runs_.at_once[count];
    for (auto& [count, timed] : runs_.at_once)
      when_fast([&, n = count, &t = timed] { engine_.time_at_once(base, n, t); });
    for (auto& [ranks, timed] : runs_.strong) when_fast([&, &t = timed] { engine_.time(base, t); });
    for (auto& [ranks, timed] : runs_.weak)
      when_fast([&, n = ranks, &t = timed] { engine_.time(runs_.larger.at(n), t); });
  }

  static constexpr double worth_saying = 1.0;  ///< [s]
  PredictRuns& engine_;
  const TurnsWanted& wanted_;
  RunsInTurns& runs_;
  bench::CorePace pace_;
};

/// What a reader should know of how the runs went.
void note_cores(const RunsInTurns& runs, std::vector<std::string>& notes) {
  if (runs.went.looks > 0 && runs.went.slow_looks > notable * runs.went.looks)
    notes.push_back(fmt::format(
        "cores were slow in {} of {} looks at them before runs (over 1.15 times the time of the fastest "
        "tenth of all looks): "
        "other work, or a program outside this machine that shares them; {:.1f} s were spent waiting",
        runs.went.slow_looks, runs.went.looks, runs.went.waited));
  if (!runs.went.settled)
    notes.push_back(
        fmt::format("the best times had not settled after {} repeats ({} in a row that lower none by {:g} "
                    "%), so quiet ones may be "
                    "lower: give more by --most-repeats",
                    runs.went.repeats, predict::Settling::even_repeats, 100.0 * predict::Settling::falls));
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
  Turns(engine, wanted, runs).make(notes);
  if (!interrupted()) note_cores(runs, notes);
  return runs;
}

}  // namespace tripoint
