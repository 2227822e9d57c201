// SPDX-License-Identifier: BSD-3-Clause
// The state that a run continues from. Columns and energy accounts are taken generically, so that a new field
// or entry is kept without a line here. Derived state (neighbour lists) is rebuilt from its own earlier
// input, never from the present state.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/errors.hpp"
#include "state/drop_particles.hpp"
#include "step/checkpoint_bounds.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

template <class T>
std::vector<double> plain(std::span<const T> values) {
  std::vector<double> out(values.size_bytes() / sizeof(double));
  if (!values.empty()) std::memcpy(out.data(), values.data(), values.size_bytes());
  return out;
}
/// The bytes between its two members are nobody's: kept as zeros, so that equal states are equal files.
std::vector<double> plain(std::span<const ExcludedPair> list) {
  static_assert(std::endian::native == std::endian::little && sizeof(ExcludedPair) == 2 * sizeof(double));
  std::vector<double> out;
  for (const ExcludedPair& pair : list)
    out.insert(out.end(), {std::bit_cast<double>(std::uint64_t{pair.other}), pair.weight});
  return out;
}
template <class T>
std::vector<double> plain(const T& value) {
  return plain(std::span<const T>(&value, 1));
}

template <class T>
std::vector<T> in_order(std::span<const T> values, std::span<const std::uint32_t> order) {
  std::vector<T> out;
  for (const std::uint32_t row : order) out.push_back(values[row]);
  return out;
}

/// @param order of the rows; empty: as they are
void save(const Columns& columns, const std::string& group, Checkpoint& kept,
          std::span<const std::uint32_t> order = {}) {
  columns.for_each([&]<class T>(const FieldInfo& field, std::span<const T> values) {
    const std::string name = group + std::string(field.name);
    const std::vector<T> ordered = in_order(values, order);
    if (!order.empty()) values = ordered;
    if constexpr (std::is_same_v<T, int>)
      kept.whole[name].assign(values.begin(), values.end());
    else
      kept.real[name] = plain(values);
  });
}

/// The array of that name. @throws InputError when it is not there or has another length
template <class Values>
const Values& take(const std::map<std::string, Values>& arrays, const std::string& name, std::size_t length) {
  const auto at = arrays.find(name);
  if (at == arrays.end()) throw InputError("the checkpoint has no " + name);
  if (at->second.size() != length)
    throw InputError("the checkpoint holds " + std::to_string(at->second.size()) + " numbers of " + name +
                     ", expected " + std::to_string(length));
  return at->second;
}

void restore_columns(Columns& columns, const std::string& group, const Checkpoint& kept) {
  columns.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
    const std::string name = group + std::string(field.name);
    if constexpr (std::is_same_v<T, int>) {
      const auto& from = take(kept.whole, name, values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::in_range<int>(from[i]))
          throw InputError("the checkpoint's " + name + " has a number beyond all bounds");
        values[i] = static_cast<int>(from[i]);
      }
    } else {
      const auto& from = take(kept.real, name, values.size_bytes() / sizeof(double));
      if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), from.data(), values.size_bytes());
    }
  });
}

/// Lists of partners in order of id up to the last that has any, as plain numbers; nothing where all are
/// empty. How many empty ones follow tells of the run's past, of which bonds had been where all are gone, and
/// not of its state.
template <class Pair>
void save(const PairLists<Pair>& lists, const std::string& name, Checkpoint& kept) {
  static_assert(std::is_trivially_copyable_v<Pair> && sizeof(Pair) % sizeof(double) == 0);
  if (lists.empty()) return;
  std::vector<double>& flat = kept.real[name + "/list"];
  std::vector<std::int64_t>& counts = kept.whole[name + "/count"];
  for (std::size_t id = 0; id < lists.particles(); ++id) {
    const std::vector<double> list = plain(lists.of(id));
    flat.insert(flat.end(), list.begin(), list.end());
    counts.push_back(static_cast<std::int64_t>(lists.of(id).size()));
  }
  while (counts.back() == 0) counts.pop_back();
}

/// @throws InputError when counts and numbers do not fit each other
template <class Pair>
void restore_pairs(PairLists<Pair>& lists, const std::string& name, const Checkpoint& kept) {
  const auto counts = kept.whole.find(name + "/count");
  lists = {};
  if (counts == kept.whole.end()) return;
  constexpr std::int64_t longest = 1 << 20;  // of a list: beyond it the sum could overflow
  std::int64_t pairs = 0;
  for (const std::int64_t n : counts->second) {
    if (n < 0 || n > longest)
      throw InputError("the checkpoint's " + name + " has a list of length " + std::to_string(n));
    pairs += n;
  }
  const std::vector<double>& flat =
      take(kept.real, name + "/list", static_cast<std::size_t>(pairs) * sizeof(Pair) / sizeof(double));
  lists.grow(counts->second.size());
  std::size_t from = 0;
  for (std::size_t id = 0; id < counts->second.size(); ++id) {
    std::vector<Pair> list(static_cast<std::size_t>(counts->second[id]));
    if (list.empty()) continue;
    std::memcpy(static_cast<void*>(list.data()), flat.data() + from, list.size() * sizeof(Pair));
    from += list.size() * sizeof(Pair) / sizeof(double);
    lists.replace(id, list);
  }
}

/// Rows as they were, each id once. @throws InputError
std::vector<std::uint32_t> row_order(const Checkpoint& kept, std::size_t particles) {
  std::vector<std::uint32_t> order;
  std::vector<bool> seen(particles, false);
  for (const std::int64_t id : take(kept.whole, "particles/id", particles)) {
    const auto n = static_cast<std::size_t>(id);
    if (id < 0 || n >= particles || seen[n])
      throw InputError("the checkpoint's particles are not each there once");
    seen[n] = true;
    order.push_back(static_cast<std::uint32_t>(n));
  }
  return order;
}

/// Lists of the same order as those that the run was cut with.
void restore_lists(State& state, const Checkpoint& kept, const std::vector<std::uint32_t>& order) {
  const std::size_t n = order.size();
  const std::vector<double>& from = take(kept.real, "neighbours/build_positions", 3 * n);
  std::vector<Vec3> built(n);
  for (std::size_t i = 0; i < n; ++i) built[i] = {from[3 * i], from[3 * i + 1], from[3 * i + 2]};
  state.neighbours->rebuild_from(state.particles, built, state.time,
                                 take(kept.whole, "neighbours/rebuilds", 1)[0]);
  const auto id = state.particles[field::id];
  for (std::size_t i = 0; i < n; ++i) {
    if (static_cast<std::uint32_t>(id[i]) != order[i])
      throw InputError("the checkpoint's rows are not those of its neighbour lists");
  }
}

void restore_bodies(State& state, const Checkpoint& kept) {
  const auto names = kept.text.find("bodies/name");
  if (names == kept.text.end() || names->second.size() < state.bodies.size())
    throw InputError("the checkpoint has other bodies than the scene");
  state.body_names = names->second;
  while (state.bodies.size() < state.body_names.size()) state.bodies.append_row();
  restore_columns(state.bodies, "bodies/", kept);
}

/// @param here layout() of this solver  @throws InputError naming the first line that differs
void refuse_another_layout(const Checkpoint& kept, const std::vector<std::string>& here) {
  const auto there = kept.text.find("step/layout");
  if (there != kept.text.end() && there->second == here) return;
  const auto differs = [&](std::size_t n) {
    return there == kept.text.end() || n >= there->second.size() || there->second[n] != here[n];
  };
  std::size_t n = 0;
  while (n + 1 < here.size() && !differs(n)) ++n;
  throw InputError("the checkpoint was written by a solver of another layout: it lacks or changes \"" +
                   here[n] + "\"");
}

void restore_accumulated(EnergyAccounts& accumulated, const Checkpoint& kept) {
  std::ranges::copy(take(kept.real, "step/booked", accumulated.values().size()),
                    accumulated.values().begin());
  const std::vector<double>& spin = take(kept.real, "step/undelivered_spin", 3);
  accumulated.undelivered_spin = {spin[0], spin[1], spin[2]};
}

void restore_all_pairs(State& state, const Checkpoint& kept) {
  restore_pairs(state.bonds, "bonds", kept);
  restore_pairs(state.own, "own_pairs", kept);
  const std::vector<std::int64_t>& pairs = take(kept.whole, "step/pairs", 2);
  if (pairs[0] != static_cast<std::int64_t>(state.bonds.pairs()) ||
      pairs[1] != static_cast<std::int64_t>(state.own.pairs()))
    throw InputError("the checkpoint lacks some of its bonds or excluded pairs");
  refuse_strange_pairs(state);
}

}  // namespace

/// Every effect and field with its carrier and type: two checkpoints of one layout hold the same arrays.
std::vector<std::string> Simulation::layout() const {
  std::vector<std::string> lines;
  const auto add = [&](const Columns& columns) {
    for (const FieldInfo& f : columns.fields())
      lines.push_back(std::string(to_string(f.per)) + " " + std::string(f.name) + " [" + std::string(f.unit) +
                      "] " + std::to_string(f.bytes) + " bytes");
  };
  add(state_.particles);
  add(state_.bodies);
  for (const Active& a : effects_)
    lines.push_back("effect " + a.name + " " + std::string(to_string(a.spec.mode)));
  for (const std::string_view name : state_.accumulated.names())
    lines.push_back("account " + std::string(name));
  for (const StepNumber& one : state_.step_numbers.declared())
    lines.push_back("step number " + std::string(one.name));
  return lines;
}

Checkpoint Simulation::checkpoint() {
  Checkpoint kept = whole_checkpoint();
  if (state_.scene.recovers) recovery_.save(kept);
  return kept;
}

Checkpoint Simulation::whole_checkpoint() {
  if (sharing_.is_part(state_)) return checkpoint_of(sharing_.whole(state_));
  form_fixed();
  return checkpoint_of(state_);
}

Checkpoint Simulation::checkpoint_of(const State& state) const {
  Checkpoint kept;
  kept.text["step/layout"] = layout();
  const bool sleeps = state.particles.moving() < state.particles.size();
  // As if nothing slept
  const std::vector<std::uint32_t> order =
      sleeps ? state.neighbours->rows_in_order(state.particles) : std::vector<std::uint32_t>{};
  save(state.particles, "particles/", kept, order);
  save(state.bodies, "bodies/", kept);
  kept.text["bodies/name"] = state.body_names;
  save(state.bonds, "bonds", kept);
  save(state.own, "own_pairs", kept);
  kept.whole["step/pairs"] = {static_cast<std::int64_t>(state.bonds.pairs()),
                              static_cast<std::int64_t>(state.own.pairs())};
  kept.real["step/booked"] = plain(state.accumulated.values());
  kept.real["step/undelivered_spin"] = plain(state.accumulated.undelivered_spin);
  const Schedule::Stretch& stretch = schedule_.stretch();
  kept.real["step/time"] = {state.time, state.next_time, dt_, pairs_, bound_.dt, stretch.start, stretch.end};
  kept.text["step/bound"] = {bound_.name};
  kept.whole["step/count"] = {steps_, static_cast<std::int64_t>(schedule_.moments_past()), stretch.count,
                              stretch.done, state.moved ? 1 : 0};
  kept.real["step/numbers"].assign(state.step_numbers.values().begin(), state.step_numbers.values().end());
  kept.real["step/guards"] = {guards_.turned_over, guards_.first_step};
  if (state.neighbours) {
    const std::span<const Vec3> built = state.neighbours->build_positions();
    const std::vector<Vec3> ordered = in_order(built, order);
    kept.real["neighbours/build_positions"] = plain(sleeps ? std::span<const Vec3>(ordered) : built);
    kept.whole["neighbours/rebuilds"] = {state.neighbours->rebuilds()};
  }
  return kept;
}

void Simulation::restore(const Checkpoint& kept) {
  refuse_another_layout(kept, layout());
  const std::vector<double>& t = take(kept.real, "step/time", 7);
  if (!std::ranges::all_of(t, [](double x) { return !std::isnan(x); }))
    throw InputError("the checkpoint's times are no numbers");
  state_.time = t[0];
  state_.next_time = t[1];
  dt_ = t[2];
  pairs_ = t[3];
  bound_.dt = t[4];
  bound_.name = take(kept.text, "step/bound", 1)[0];
  const std::vector<std::int64_t>& n = take(kept.whole, "step/count", 5);
  steps_ = n[0];
  state_.moved = n[4] != 0;
  schedule_.restore(static_cast<std::size_t>(n[1]), {t[5], t[6], n[2], n[3]});
  restore_accumulated(state_.accumulated, kept);
  // Particles that had flowed in
  if (const auto ids = kept.whole.find("particles/id"); ids != kept.whole.end()) {
    while (state_.particles.size() < ids->second.size()) state_.particles.append();
    if (state_.particles.size() > ids->second.size()) {  // and that had flowed out
      keep_particles(state_, ids->second.size());
      for (const Active& a : effects_) a.effect->renumber(state_);
    }
  }
  const std::vector<std::uint32_t> order = row_order(kept, state_.particles.size());
  state_.particles.permute(order);  // rows were in order of id
  restore_all_pairs(state_, kept);
  if (state_.neighbours) {
    restore_lists(state_, kept, order);
    state_.neighbours->mark_own(state_.particles, state_.own);
    passes_.drop_clusters();
  }
  restore_columns(state_.particles, "particles/", kept);
  restore_bodies(state_, kept);
  refuse_strange_columns(state_);
  const std::vector<double>& guards = take(kept.real, "step/guards", 2);
  guards_.turned_over = guards[0];
  guards_.first_step = guards[1];
  const std::span<double> numbers = state_.step_numbers.values();
  std::ranges::copy(take(kept.real, "step/numbers", numbers.size()), numbers.begin());
  if (options_.halo) sharing_.follow(state_, effects_, passes_);
}

}  // namespace tripoint
