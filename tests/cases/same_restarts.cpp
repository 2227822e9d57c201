// SPDX-License-Identifier: BSD-3-Clause
/// Whether cases that are cut and go on have the bits of one unbroken run: cut at the first steps, at steps
/// in which particles melt, freeze, join, part, tear or flow in, and between; gone on with on 1, 2 and 3
/// threads, and from the cut of a cut.
///   same-restarts [--budget PARTICLE-STEPS] [--every-step N] CASE.toml...
/// --every-step N: cut after every step from 1 to N, and after every one of N steps about the first of each
/// kind of change. A row a state says how many cuts lie in a step that melts, freezes, changes bodies,
/// changes bonds, lets particles flow in or meets an event, and whether the run was cut after each of its
/// steps to its end: then N and the budget have left nothing out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sampling/sample.hpp"
#include "step/settle.hpp"
#include "step/simulation.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

namespace {

constexpr long goes_on = 8;             ///< steps after a cut, where the run has as many
constexpr std::size_t most_turns = 12;  ///< cuts at a change, of each state

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Name of the first array in which two states differ; "" where none does.
std::string difference(const Checkpoint& a, const Checkpoint& b) {
  for (const auto& [name, values] : b.real)
    if (!a.real.contains(name)) return name + ", which the unbroken run does not have,";
  for (const auto& [name, values] : b.whole)
    if (!a.whole.contains(name)) return name + ", which the unbroken run does not have,";
  for (const auto& [name, values] : a.real)
    if (const auto at = b.real.find(name); at == b.real.end() || !same(values, at->second)) return name;
  for (const auto& [name, values] : a.whole)
    if (const auto at = b.whole.find(name); at == b.whole.end() || values != at->second) return name;
  return a.text == b.text ? "" : "text";
}

struct Start {
  Scene scene;
  InitialState initial;
};

/// Of changes within a step
constexpr std::array kinds{"melts", "freezes", "bodies", "bonds", "inflow", "events"};

/// Steps in which something changed: of any kind, and of each.
struct Turns {
  std::vector<long> any;
  std::array<std::vector<long>, kinds.size()> of;
};

struct Counts {
  long states = 0, unequal = 0, cuts = 0, turns = 0, restarts = 0, every_step = 0, whole = 0;
  std::set<std::string> whole_cases;
  std::array<long, kinds.size()> of{};
};

/// Steps to an output, to the one after it and so on, as a run does, until go_on says no. It is told to which
/// one the steps lead.
/// @param output the first to step to, from 1: a run that recovers may have gone back behind one that it has
/// written
void go(Simulation& s, const Scene& scene, long output, const std::function<bool(long)>& go_on) {
  const double every = scene.output_interval > 0.0 ? scene.output_interval : scene.end_time;
  for (;; ++output) {
    const double next = std::min(static_cast<double>(output) * every, scene.end_time);
    bool goes = true;
    s.advance_to(next, [&] { return goes = go_on(output); });
    if (!goes || !(next < scene.end_time)) return;
  }
}

/// Which kinds of change the last step brought, between `before` [s] and now.
std::array<bool, kinds.size()> changes_of(const State& state, const Scene& scene, double before) {
  const Change& change = state.change;
  const bool meets_event = std::ranges::any_of(
      scene.events, [&](const Event& e) { return before < e.time && e.time <= state.time; });
  return {!change.melted.empty(),   !change.frozen.empty(), !change.bodies.empty(),
          !change.relisted.empty(), !change.born.empty(),   meets_event};
}

/// Steps of an unbroken run in which something changed, and how many it had. A step is counted each time that
/// it is made: a run that recovers goes back, and makes steps of the same number again.
Turns turns_of(const Start& start, long most, long& steps) {
  Turns turns;
  Simulation s(start.scene, start.initial, {.force_time_step = true});
  double before = s.state().time;
  steps = 0;
  go(s, start.scene, 1, [&](long) {
    ++steps;
    if (!s.state().change.empty()) turns.any.push_back(steps);
    const auto changes = changes_of(s.state(), start.scene, before);
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (changes[k]) turns.of[k].push_back(steps);
    before = s.state().time;
    return steps < most;
  });
  return turns;
}

/// Steps from 1 to n, and n about the first change of each kind.
std::set<long> every_step(const Turns& turns, long n) {
  std::set<long> cuts;
  for (long at = 1; at <= n; ++at) cuts.insert(at);
  for (const std::vector<long>& some : turns.of)
    for (long at = 0; at < n && !some.empty(); ++at) cuts.insert(some.front() - n / 2 + at);
  return cuts;
}

std::set<long> cuts_of(const Turns& turns, long steps, Counts& counts) {
  std::set<long> cuts{1, 2, 3, steps / 3, steps / 2, 2 * steps / 3};
  const std::size_t some = std::min(turns.any.size(), most_turns);
  for (std::size_t k = 0; k < some; ++k) cuts.insert(turns.any[k * turns.any.size() / some]);
  if (counts.every_step > 0) cuts = every_step(turns, counts.every_step);
  const long last = counts.every_step > 0 ? steps - 1 : steps - goes_on;
  std::erase_if(cuts, [&](long at) { return at < 1 || at > last; });
  return cuts;
}

/// How many cuts lie in such steps.
long inside(const std::set<long>& cuts, const std::vector<long>& turns) {
  return std::ranges::count_if(cuts, [&](long at) { return std::ranges::binary_search(turns, at); });
}

/// A state that is kept, and the output to which its run was on the way.
struct Kept {
  Checkpoint state;
  long output = 1;
};

/// The state so many steps after a cut. @param cut_again after how many of them it is cut once more; as many:
/// it is not
Checkpoint after(const Start& start, const Kept& cut, int threads, long steps, long cut_again) {
  const SimulationOptions options{.threads = threads, .force_time_step = true};
  Simulation s(start.scene, start.initial, options, cut.state);
  long made = 0, output = cut.output;
  go(s, start.scene, cut.output, [&](long towards) {
    output = towards;
    return ++made < cut_again;
  });
  if (cut_again == steps) return s.checkpoint();
  return after(start, {s.checkpoint(), output}, threads, steps - cut_again, steps - cut_again);
}

/// @return whether all restarts agree
bool agrees(const std::string& name, const Start& start, long most, Counts& counts) {
  long steps = 0;
  const Turns turns = turns_of(start, most, steps);
  const std::set<long> cuts = cuts_of(turns, steps, counts);
  std::map<long, Kept> at;
  Simulation unbroken(start.scene, start.initial, {.force_time_step = true});
  long now = 0;
  go(unbroken, start.scene, 1, [&](long output) {
    ++now;
    const bool is_goal =
        now == steps || cuts.contains(now - goes_on) || cuts.contains(now - goes_on - goes_on / 2);
    if (is_goal || cuts.contains(now)) at[now] = {unbroken.checkpoint(), output};
    return now < steps;
  });
  for (const long cut : cuts) {
    for (const int threads : {1, 2, 3}) {
      const bool halfway = threads == 2 && at.contains(cut + goes_on + goes_on / 2);
      const long goal = std::min(steps, cut + goes_on + (halfway ? goes_on / 2 : 0));
      const Checkpoint there = after(start, at.at(cut), threads, goal - cut, halfway ? goes_on : goal - cut);
      const std::string what = difference(at.at(goal).state, there);
      ++counts.restarts;
      if (what.empty()) continue;
      fmt::print("{}: cut after step {} and gone on with on {} threads{}, {} differs at step {}\n", name, cut,
                 threads, halfway ? ", cut again," : "", what, goal);
      ++counts.unequal;
      return false;
    }
  }
  counts.cuts += static_cast<long>(cuts.size());
  counts.turns += inside(cuts, turns.any);
  ++counts.states;
  const bool whole = steps < most && static_cast<long>(cuts.size()) == steps - 1;
  if (whole) {
    ++counts.whole;
    counts.whole_cases.insert(name.substr(0, name.find(' ')));
  }
  if (counts.every_step > 0) fmt::print("{:44} {:6} {:6}", name, steps, cuts.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const long within = inside(cuts, turns.of[k]);
    counts.of[k] += within;
    if (counts.every_step > 0) fmt::print("{:>8}", within);
  }
  if (counts.every_step > 0) {
    fmt::print("   equal{}\n", whole ? ", whole run" : "");
    std::fflush(stdout);
  }
  return true;
}

bool agrees(const std::string& file, Mode mode, double budget, Counts& counts) {
  const CaseReading reading = read_case(file);
  RunChoice choice;
  choice.mode = mode;
  const std::string name = fmt::format("{} {}", reading.value.id, to_string(mode));
  Start start{scene_for(reading.value, choice), {}};
  start.initial = sample(start.scene);
  const auto most = static_cast<long>(
      std::clamp(budget / static_cast<double>(std::max<std::size_t>(1, start.initial.size())), 20.0, 5000.0));
  try {
    return agrees(name, start, most, counts);
  } catch (const InputError& e) {  // a scene that the solver does not take
    fmt::print("{}: left out, {}\n", name, e.what());
  } catch (const Diverged& e) {  // one that is meant to fail
    fmt::print("{}: left out, {}\n", name, e.what());
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  tripoint::set_settler(tripoint::settled);
  double budget = 2e5;
  bool all = true;
  Counts counts;
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--budget" && i + 1 < argc) {
        budget = std::atof(argv[++i]);
        continue;
      }
      if (std::string_view(argv[i]) == "--every-step" && i + 1 < argc) {
        counts.every_step = std::max(1L, std::atol(argv[++i]));
        fmt::print("{:44} {:>6} {:>6}", "cuts in a step that", "steps", "cuts");
        for (const char* kind : kinds) fmt::print("{:>8}", kind);
        fmt::print("\n");
        continue;
      }
      for (const Mode mode : read_case(argv[i]).value.modes)
        all = agrees(argv[i], mode, budget, counts) && all;
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "same-restarts: {}\n", e.what());
    return 2;
  }
  for (std::size_t k = 0; k < kinds.size() && counts.every_step > 0; ++k)
    fmt::print("{} cuts: {}\n", kinds[k], counts.of[k]);
  if (counts.every_step > 0)
    fmt::print("{} states of {} cases cut after each of their steps to the end\n", counts.whole,
               counts.whole_cases.size());
  fmt::print("{} states, {} cuts, {} of them at a change, {} restarts; {} more states with other bits\n",
             counts.states, counts.cuts, counts.turns, counts.restarts, counts.unequal);
  return all && counts.states > 0 ? 0 : 1;
}
