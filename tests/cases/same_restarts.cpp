// SPDX-License-Identifier: BSD-3-Clause
/// Whether cases that are cut and go on have the bits of one unbroken run: cut at the first steps, at steps in which particles melt, freeze,
/// join, part, tear or flow in, and between; gone on with on 1, 2 and 3 threads, and from the cut of a cut.
///   same-restarts [--budget PARTICLE-STEPS] CASE.toml...
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/read_case.hpp"
#include "step/settle.hpp"
#include "step/simulation.hpp"

using namespace tripoint;

namespace {

constexpr long goes_on = 8;              ///< steps after a cut
constexpr std::size_t most_turns = 12;  ///< cuts at a change, of each state

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

/// Name of the first array in which two states differ; "" where none does.
std::string difference(const Checkpoint& a, const Checkpoint& b) {
  if (a.real.size() != b.real.size() || a.whole.size() != b.whole.size()) return "the set of arrays";
  for (const auto& [name, values] : a.real)
    if (const auto at = b.real.find(name); at == b.real.end() || !same(values, at->second)) return name;
  for (const auto& [name, values] : a.whole)
    if (const auto at = b.whole.find(name); at == b.whole.end() || values != at->second) return name;
  return a.text == b.text ? "" : "text";
}

struct State {
  Scene scene;
  InitialState initial;
};

struct Counts {
  long states = 0, cuts = 0, turns = 0, restarts = 0;
};

/// Steps to the next output, to the one after it and so on, as a run does, until go_on says no.
void go(Simulation& s, const Scene& scene, const std::function<bool()>& go_on) {
  const double every = scene.output_interval > 0.0 ? scene.output_interval : scene.end_time;
  double k = std::max(0.0, std::floor(s.world().time / every) - 1.0);
  while (k * every <= s.world().time) k += 1.0;  // the very next one, however near: an event may lie a rounding error before it
  for (;; k += 1.0) {
    const double next = std::min(k * every, scene.end_time);
    bool goes = true;
    s.advance_to(next, [&] { return goes = go_on(); });
    if (!goes || !(next < scene.end_time)) return;
  }
}

/// Steps of an unbroken run in which something changed, and how many it had.
std::vector<long> turns_of(const State& state, long most, long& steps) {
  std::vector<long> turns;
  Simulation s(state.scene, state.initial, {.force_time_step = true});
  go(s, state.scene, [&] {
    if (!s.world().change.empty()) turns.push_back(s.steps());
    return s.steps() < most;
  });
  steps = s.steps();
  return turns;
}

std::set<long> cuts_of(const std::vector<long>& turns, long steps, Counts& counts) {
  std::set<long> cuts{1, 2, 3, steps / 3, steps / 2, 2 * steps / 3};
  const std::size_t some = std::min(turns.size(), most_turns);
  for (std::size_t k = 0; k < some; ++k) cuts.insert(turns[k * turns.size() / some]);
  std::erase_if(cuts, [&](long at) { return at < 1 || at + goes_on > steps; });
  counts.turns += std::ranges::count_if(cuts, [&](long at) { return std::ranges::binary_search(turns, at); });
  return cuts;
}

/// The state so many steps after a cut. @param halfway cut once more on the way
Checkpoint after(const State& state, const Checkpoint& cut, int threads, bool halfway) {
  const SimulationOptions options{.threads = threads, .force_time_step = true};
  Simulation s(state.scene, state.initial, options, cut);
  const long goal = s.steps() + goes_on, stop = halfway ? goal - goes_on / 2 : goal;
  go(s, state.scene, [&] { return s.steps() < stop; });
  if (!halfway) return s.checkpoint();
  return after(state, s.checkpoint(), threads, false);
}

/// @return whether all restarts agree
bool agrees(const std::string& name, const State& state, long most, Counts& counts) {
  long steps = 0;
  const std::vector<long> turns = turns_of(state, most, steps);
  const std::set<long> cuts = cuts_of(turns, steps, counts);
  std::map<long, Checkpoint> at;
  Simulation unbroken(state.scene, state.initial, {.force_time_step = true});
  go(unbroken, state.scene, [&] {
    const long now = unbroken.steps();
    for (const long wanted : {now, now - goes_on, now - goes_on - goes_on / 2})
      if (cuts.contains(wanted)) at[now] = unbroken.checkpoint();
    return now < steps;
  });
  for (const long cut : cuts) {
    for (const int threads : {1, 2, 3}) {
      const bool halfway = threads == 2 && at.contains(cut + goes_on + goes_on / 2);
      const long goal = cut + goes_on + (halfway ? goes_on / 2 : 0);
      const std::string what = difference(at.at(goal), after(state, at.at(cut), threads, halfway));
      ++counts.restarts;
      if (what.empty()) continue;
      fmt::print("{}: cut after step {} and gone on with on {} threads{}, {} differs at step {}\n", name, cut, threads, halfway ? ", cut again," : "", what, goal);
      return false;
    }
  }
  counts.cuts += static_cast<long>(cuts.size());
  ++counts.states;
  return true;
}

bool agrees(const std::string& file, Mode mode, double budget, Counts& counts) {
  const CaseReading reading = read_case(file);
  RunChoice choice;
  choice.mode = mode;
  const std::string name = fmt::format("{} {}", reading.value.id, to_string(mode));
  State state{scene_for(reading.value, choice), {}};
  state.initial = sample(state.scene);
  const auto most = static_cast<long>(std::clamp(budget / static_cast<double>(std::max<std::size_t>(1, state.initial.size())), 20.0, 5000.0));
  try {
    return agrees(name, state, most, counts);
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
      for (const Mode mode : read_case(argv[i]).value.modes) all = agrees(argv[i], mode, budget, counts) && all;
    }
  } catch (const std::exception& e) {
    return fmt::print(stderr, "same-restarts: {}\n", e.what()), 2;
  }
  fmt::print("{} states, {} cuts, {} of them at a change, {} restarts\n", counts.states, counts.cuts, counts.turns, counts.restarts);
  return all && counts.states > 0 ? 0 : 1;
}
