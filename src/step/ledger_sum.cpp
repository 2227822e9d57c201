// SPDX-License-Identifier: BSD-3-Clause
#include "step/ledger_sum.hpp"

#include "step/each_effect.hpp"

namespace tripoint {

Ledger own_ledger(const State& state, const std::vector<Active>& effects) {
  Ledger sum;
  const auto m = state.particles[field::mass];
  for (std::size_t id = 0; id < m.size(); ++id)
    if (const std::size_t row = state.particles.row(id); state.owns(row)) sum.mass += m[row];
  for_each_effect(state, effects, [&](const Effect& effect) { effect.add_to(state, sum); });
  close_ledger(state, sum);
  return sum;
}

namespace {

/// An entry that one of the processes has, since something stands on its energy account, all have.
void add_entries_of_others(const State& state, Ledger& sum) {
  std::vector<std::string> entries;
  for (const Force& f : state.forces)
    if (f.stored && f.stored->released && !f.stored->released_to.empty())
      entries.emplace_back(f.stored->released_to);
  std::vector<double> there;
  for (const std::string& entry : entries) there.push_back(sum.energy.contains(entry) ? 1.0 : 0.0);
  state.halo->add(there);
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (there[k] > 0.0) sum.energy.try_emplace(entries[k], 0.0);
}

}  // namespace

Ledger ledger_of_all(const State& state, const std::vector<Active>& effects) {
  Ledger sum = own_ledger(state, effects);
  if (!state.halo) return sum;
  add_entries_of_others(state, sum);
  std::vector<double> numbers{sum.mass};
  for (const Vec3* v : {&sum.momentum, &sum.angular_momentum})
    numbers.insert(numbers.end(), {v->x, v->y, v->z});
  for (const auto& [entry, energy] : sum.energy) numbers.push_back(energy);
  state.halo->add(numbers);
  sum.mass = numbers[0];
  sum.momentum = {numbers[1], numbers[2], numbers[3]};
  sum.angular_momentum = {numbers[4], numbers[5], numbers[6]};
  std::size_t next = 7;
  for (auto& [entry, energy] : sum.energy) energy = numbers[next++];
  return sum;
}

}  // namespace tripoint
