// SPDX-License-Identifier: BSD-3-Clause
#include "state/ledger.hpp"

#include "scene/effect_rule.hpp"
#include "scene/ledger_entry.hpp"
#include "state/state.hpp"

namespace tripoint {
namespace {

double paid_by_drivers(const EnergyAccounts& accumulated, const Force& f) {
  return f.work_on_driven ? accumulated[*f.work_on_driven] : 0.0;
}

double stored_now(const Ledger& ledger, const StoredEnergy& stored) {
  double sum = 0.0;
  for (const std::string_view entry : stored.entries)
    if (const auto at = ledger.energy.find(std::string(entry)); at != ledger.energy.end()) sum += at->second;
  return sum;
}

/// Entries that every scene with forces tells, 0 where their effect is off.
void report_common_entries(const State& state, Ledger& sum) {
  for (const EffectRule& rule : effect_rules())
    if (rule.always_reported)
      for (const std::string_view entry : rule.always_reported(state.scene))
        sum.energy.try_emplace(std::string(entry), 0.0);
}

/// Energy left by finite steps for one force: 0 to round-off where its work equals the energy taken from its
/// store.
double by_finite_steps(const State& state, const Force& f, const Ledger& sum) {
  const StoredEnergy& stored = *f.stored;
  const double change = stored_now(sum, stored) - state.accumulated[stored.at_start];
  const double released = stored.released ? state.accumulated[*stored.released] : 0.0;
  return change + released + (state.accumulated[f.work] + paid_by_drivers(state.accumulated, f));
}

}  // namespace

void accumulate_start(State& state, const Ledger& start) {
  for (const Force& f : state.forces)
    if (f.stored) state.accumulated[f.stored->at_start] = stored_now(start, *f.stored);
  if (const auto potential = start.energy.find(ledger_entry::potential); potential != start.energy.end())
    state.accumulated[account::start_potential] =
        potential->second - state.accumulated[account::driven_potential];
}

void close_ledger(const State& state, Ledger& sum) {
  const EnergyAccounts& accumulated = state.accumulated;
  if (!state.forces.empty() || !state.scene.springs.empty() || !state.scene.joints.empty()) {
    report_common_entries(state, sum);
    double made = -0.0, on_driven = 0.0;  // -0.0 less nothing is -0.0, as the entry always began
    for (const EnergyAccount& a : state.numerical) made -= accumulated[a];
    for (const Force& f : state.forces) {
      on_driven += paid_by_drivers(accumulated, f);
      if (f.stored)
        made -= by_finite_steps(state, f, sum);
      else
        sum.energy[std::string(f.entry)] -= accumulated[f.work] + paid_by_drivers(accumulated, f);
      if (f.stored && f.stored->released && !f.stored->released_to.empty() &&
          accumulated[*f.stored->released] != 0.0)
        sum.energy[std::string(f.stored->released_to)] += accumulated[*f.stored->released];
    }
    sum.energy["walls"] += on_driven;
    const double potential = sum.energy[ledger_entry::potential] - accumulated[account::start_potential] -
                             accumulated[account::driven_potential];
    sum.energy[ledger_entry::time_integration] =
        made - (potential + accumulated[account::gravity_work]) - accumulated[account::rotation_drift];
  }
  sum.energy["merging"] += accumulated[account::merging];
  sum.energy["walls"] += accumulated[account::walls];
}

}  // namespace tripoint
