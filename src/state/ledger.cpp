// SPDX-License-Identifier: BSD-3-Clause
#include "state/ledger.hpp"

#include "scene/effect_rule.hpp"
#include "scene/ledger_entry.hpp"
#include "state/state.hpp"

namespace tripoint {
namespace {

double paid_by_drivers(const Bookings& booked, const Force& f) {
  return f.work_on_driven ? booked[*f.work_on_driven] : 0.0;
}

double stored_now(const Ledger& ledger, const StoredEnergy& stored) {
  double sum = 0.0;
  for (const std::string_view entry : stored.entries)
    if (const auto at = ledger.energy.find(std::string(entry)); at != ledger.energy.end()) sum += at->second;
  return sum;
}

/// Entries that every scene with forces tells, 0 where their effect is off.
void tell_common_entries(const State& state, Ledger& sum) {
  for (const EffectRule& rule : effect_rules())
    if (rule.always_told)
      for (const std::string_view entry : rule.always_told(state.scene))
        sum.energy.try_emplace(std::string(entry), 0.0);
}

/// Energy left by finite steps for one force: 0 to round-off where its work equals the energy taken from its
/// store.
double by_finite_steps(const State& state, const Force& f, const Ledger& sum) {
  const StoredEnergy& stored = *f.stored;
  const double change = stored_now(sum, stored) - state.booked[stored.at_start];
  const double released = stored.released ? state.booked[*stored.released] : 0.0;
  return change + released + (state.booked[f.work] + paid_by_drivers(state.booked, f));
}

}  // namespace

void book_start(State& state, const Ledger& start) {
  for (const Force& f : state.forces)
    if (f.stored) state.booked[f.stored->at_start] = stored_now(start, *f.stored);
  if (const auto potential = start.energy.find(ledger_entry::potential); potential != start.energy.end())
    state.booked[account::start_potential] = potential->second - state.booked[account::driven_potential];
}

void close_ledger(const State& state, Ledger& sum) {
  const Bookings& booked = state.booked;
  if (!state.forces.empty()) {
    tell_common_entries(state, sum);
    double made = -0.0, on_driven = 0.0;  // -0.0 less nothing is -0.0, as the entry always began
    for (const Account& a : state.numerical) made -= booked[a];
    for (const Force& f : state.forces) {
      on_driven += paid_by_drivers(booked, f);
      if (f.stored)
        made -= by_finite_steps(state, f, sum);
      else
        sum.energy[std::string(f.entry)] -= booked[f.work] + paid_by_drivers(booked, f);
      if (f.stored && f.stored->released && !f.stored->released_to.empty() &&
          booked[*f.stored->released] != 0.0)
        sum.energy[std::string(f.stored->released_to)] += booked[*f.stored->released];
    }
    sum.energy["walls"] += on_driven;
    const double potential = sum.energy[ledger_entry::potential] - booked[account::start_potential] -
                             booked[account::driven_potential];
    sum.energy[ledger_entry::time_integration] =
        made - (potential + booked[account::gravity_work]) - booked[account::rotation_drift];
  }
  sum.energy["merging"] += booked[account::merging];
  sum.energy["walls"] += booked[account::walls];
}

}  // namespace tripoint
