// SPDX-License-Identifier: BSD-3-Clause
#include "step/sharing.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "state/failure.hpp"

namespace tripoint {
namespace {

bool splits(const Halo& halo) {
  const std::array<bool, 3> split = halo.splits();
  return std::ranges::find(split, true) != split.end();
}

/// Sums of this process over its own particles, body by body.
std::vector<std::vector<double>> body_sums(const State& state) {
  std::vector<std::vector<double>> sums;
  for (const Field<double>& f : state.body_sums) {
    const auto column = state.bodies[f];
    sums.emplace_back(column.begin(), column.end());
  }
  return sums;
}

/// Puts them back; bodies that came to be since have 0. @param sums as body_sums() gave them; none: all are 0
void set_body_sums(State& state, std::vector<std::vector<double>> sums) {
  sums.resize(state.body_sums.size());
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const auto column = state.bodies[state.body_sums[n]];
    sums[n].resize(column.size());
    std::ranges::copy(sums[n], column.begin());
  }
}

/// Positions of the particles when the present lists were made, by number, for each process that holds a part
/// of them. Where a process has no lists, some particles are missing.
std::vector<Vec3> gather_built(const State& state) {
  const std::span<const Vec3> built = state.neighbours->build_positions();
  const std::span<const int> number = state.halo->numbers();
  std::vector<double> own;
  for (std::size_t id = 0; id < state.halo->owned() && built.size() == state.particles.size(); ++id) {
    const Vec3& r = built[state.particles.row(id)];
    own.insert(own.end(), {static_cast<double>(number[id]), r.x, r.y, r.z});
  }
  const std::vector<double> all = state.halo->all_of(own);
  std::vector<Vec3> places(all.size() / 4);
  for (std::size_t k = 0; k < all.size(); k += 4)
    places[static_cast<std::size_t>(all[k])] = {all[k + 1], all[k + 2], all[k + 3]};
  return places;
}

std::vector<Vec3> by_id(const Particles& p, std::span<const Vec3> by_row) {
  std::vector<Vec3> values;
  for (std::size_t id = 0; id < by_row.size(); ++id) values.push_back(by_row[p.row(id)]);
  return values;
}

std::vector<double> by_id(const State& state, const std::vector<double>& by_row) {
  std::vector<double> cost(by_row.size());
  for (std::size_t id = 0; id < cost.size(); ++id) cost[id] = by_row[state.particles.row(id)];
  return cost;
}

/// Places of the last lists, by row of the part that this process has. @param built of the whole, by number
std::vector<Vec3> built_here(const State& state, const std::vector<Vec3>& built) {
  const std::span<const int> number = state.halo->numbers();
  std::vector<Vec3> here(number.size());
  for (std::size_t id = 0; id < here.size(); ++id)
    here[state.particles.row(id)] = built[static_cast<std::size_t>(number[id])];
  return here;
}

/// Facts about the whole scene that the lists of this part need. @param places by row, that they are made at
Whole whole_of(const State& state, std::span<const Vec3> places, std::size_t particles) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Whole whole{{none, none, none}, {-none, -none, -none}, particles, {}, state.halo->owned()};
  for (const Vec3& r : places)
    for (std::size_t a = 0; a < 3; ++a) {
      whole.low[a] = std::min(whole.low[a], r[a]);
      whole.high[a] = std::max(whole.high[a], r[a]);
    }
  const std::vector<double> all =
      state.halo->all_of({whole.low.x, whole.low.y, whole.low.z, whole.high.x, whole.high.y, whole.high.z});
  for (std::size_t k = 0; k < all.size(); k += 6)
    for (std::size_t a = 0; a < 3; ++a) {
      whole.low[a] = std::min(whole.low[a], all[k + a]);
      whole.high[a] = std::max(whole.high[a], all[k + 3 + a]);
    }
  whole.numbers.assign(state.halo->numbers().begin(), state.halo->numbers().end());
  return whole;
}

/// A failure as numbers, which go between processes: each word is its length and its letters.
std::vector<double> as_numbers(const Diverged& e) {
  std::vector<double> numbers{static_cast<double>(e.particle), static_cast<double>(e.body), e.time};
  for (const std::string& word : {e.field, e.stage, e.guard, std::string(e.what())}) {
    numbers.push_back(static_cast<double>(word.size()));
    for (const char letter : word) numbers.push_back(letter);
  }
  return numbers;
}

/// @param from the first of its numbers; then the first behind them
Diverged failure_at(const double*& from) {
  const auto particle = static_cast<long>(from[0]), body = static_cast<long>(from[1]);
  const double time = from[2];
  from += 3;
  std::array<std::string, 4> words;
  for (std::string& word : words) {
    word.resize(static_cast<std::size_t>(*from++));
    for (char& letter : word) letter = static_cast<char>(*from++);
  }
  return {particle, body, words[0], words[1], time, words[3], words[2]};
}

/// LAMMPS has no place for a particle that is nowhere. @throws Diverged
void refuse_lost(const State& state) {
  constexpr double farthest = 1e100;  // [m], whose square is a number
  const auto x = positions(state.particles);
  for (std::size_t id = 0; id < state.halo->owned(); ++id)
    if (const std::size_t row = state.particles.row(id); !(norm(x.at(row)) <= farthest))
      fail(state, GuardName::finite, row, "position", "drift", "has no finite position");
}

std::vector<Vec3> places_now(const Particles& p) {
  const auto x = positions(p);
  std::vector<Vec3> places(p.size());
  for (std::size_t row = 0; row < p.size(); ++row) places[row] = x.at(row);
  return places;
}

}  // namespace

bool Sharing::is_part(const State& state) const { return state.halo && splits(*state.halo); }

bool Sharing::any(bool here) const {
  double least = here ? -1.0 : 0.0;
  std::string unused;
  halo_->take_least(least, unused);
  return least < 0.0;
}

std::optional<Diverged> Sharing::first_failure(const std::optional<Diverged>& here) const {
  if (!any(here.has_value())) return {};
  const std::vector<double> all = halo_->all_of(here ? as_numbers(*here) : std::vector<double>{});
  std::optional<Diverged> first;
  for (const double* from = all.data(); from != all.data() + all.size();)
    if (const Diverged one = failure_at(from); !first || one.particle < first->particle) first.emplace(one);
  return first;
}

void Sharing::begin_anew() {
  accumulated_.reset();
  part_.reset();
  count_ = 0;
  if (halo_) halo_->begin_anew();
}

/// Where there are no neighbour lists, as if there were.
bool Sharing::outdated(const State& state) const {
  const Particles& p = state.particles;
  if (state.neighbours) return state.neighbours->outdated(p);
  if (shared_at_.size() != p.size()) return true;
  const double limit = 0.5 * skin_ * state.support();
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(norm(x.at(i) - shared_at_[i]) <= limit)) return true;
  return false;
}

void Sharing::gather(State& state, const std::vector<Active>& effects) {
  if (!is_part(state)) return;
  accumulated_ = {state.accumulated, body_sums(state)};
  part_ = hold_whole(state);
  gathered_ = {state.bonds.changes(), state.own.changes()};
  for (const Active& a : effects) a.effect->renumber(state);
}

/// Of the whole only the rows that change are asked for their lists.
Sharing::Part Sharing::hold_whole(State& state) const {
  state.body_owners.complete(state);
  state.body_owners = {};
  const std::vector<Vec3> built = state.neighbours ? gather_built(state) : std::vector<Vec3>{};
  WholeScene whole = state.halo->gather(state.particles, state.bonds, state.own);
  Part part{std::exchange(state.particles, std::move(whole.particles)),
            std::exchange(state.bonds, std::move(whole.bonds)),
            std::exchange(state.own, std::move(whole.own)),
            {}};
  state.halo = nullptr;
  state.ghosts.clear();
  if (!state.neighbours) return part;
  const long rebuilds = state.neighbours->rebuilds();
  Neighbours lists = state.neighbours->anew(state.box);
  lists.list_when_asked();
  std::swap(lists, *state.neighbours);
  if (built.size() == state.particles.size()) {
    part.neighbours = std::move(lists);
    state.neighbours->rebuild_from(state.particles, built, state.time, rebuilds + 1);
  } else {
    state.neighbours->update(state.particles, state.time);
  }
  state.neighbours->mark_own(state.particles, state.own);
  return part;
}

State Sharing::whole(const State& part) const {
  State state = part;
  static_cast<void>(hold_whole(state));
  halo_->add(state.accumulated.values());
  for (const Field<double>& f : state.body_sums) halo_->add(state.bodies[f]);
  std::string unused;
  for (const StepNumber& one : state.step_numbers.declared())
    if (one.least_of_processes) halo_->take_least(state.step_numbers[one], unused);
  return state;
}

void Sharing::share_out(State& state, const Passes& passes) {
  state.halo = halo_;
  if (!halo_->is_first()) {
    set_body_sums(state, accumulated_ ? accumulated_->body_sums : std::vector<std::vector<double>>{});
    if (accumulated_)
      state.accumulated = accumulated_->accounts;
    else
      state.accumulated.clear();
  }
  accumulated_.reset();
  if (can_take_back(state))
    take_back(state);
  else
    share_particles(state, passes);
  part_.reset();
}

/// Whether each process can go on with the part that it had, and with its lists. All find the same.
bool Sharing::can_take_back(const State& state) const {
  return part_ && part_->neighbours && state.particles.size() == count_ &&
         state.neighbours->rebuilds() == part_->neighbours->rebuilds() + 1 &&
         !state.neighbours->outdated(state.particles);
}

/// Every particle of the part takes what was decided of it.
void Sharing::take_back(State& state) {
  const Particles whole = std::exchange(state.particles, std::move(part_->particles));
  const std::span<const int> number = halo_->numbers();
  const auto ids = state.particles[field::id];
  const std::vector<int> id(ids.begin(), ids.end());
  std::vector<std::uint32_t> rows;
  for (const int one : id)
    rows.push_back(static_cast<std::uint32_t>(whole.row(static_cast<std::size_t>(number[one]))));
  state.particles.copy(whole, rows);
  std::ranges::copy(id, state.particles[field::id].begin());
  const long rebuilds = state.neighbours->rebuilds();
  state.neighbours = std::move(part_->neighbours);
  state.neighbours->renew(rebuilds + 1);
  if (gathered_ != std::array{state.bonds.changes(), state.own.changes()})
    return halo_->share_lists(state.bonds, state.own);
  state.bonds = std::move(part_->bonds);
  state.own = std::move(part_->own);
}

/// Lists that are not outdated stay. A part then has the lists that one process has of the whole.
void Sharing::share_particles(State& state, const Passes& passes) {
  const bool keeps = state.neighbours && !state.neighbours->outdated(state.particles);
  const std::vector<Vec3> built =
      keeps ? by_id(state.particles, state.neighbours->build_positions()) : std::vector<Vec3>{};
  const bool are_new = count_ != state.particles.size();
  count_ = state.particles.size();
  halo_->share_out(state.particles, state.bonds, state.own, state.box, built,
                   are_new ? by_id(state, passes.cost_at_start(state)) : std::vector<double>{});
  if (!state.neighbours) return;
  const long rebuilds = state.neighbours->rebuilds();
  state.neighbours = state.neighbours->anew(state.box);
  const std::vector<Vec3> here = keeps ? built_here(state, built) : places_now(state.particles);
  if (is_part(state)) state.neighbours->drop_lists(whole_of(state, here, count_));
  if (keeps) state.neighbours->rebuild_from(state.particles, here, state.time, rebuilds + 1);
}

void Sharing::follow(State& state, const std::vector<Active>& effects, const Passes& passes) {
  if (!state.halo) {
    share_out(state, passes);
  } else if (!is_part(state) && state.particles.size() != count_) {
    // One rank holds the whole always: lists may know inflowing particles already
    share_particles(state, passes);
  } else {
    ++steps_;
    if (!any(outdated(state))) return;
    look_together(state, [&] { refuse_lost(state); });
    steps_a_list_ = 0.5 * (steps_a_list_ + static_cast<double>(std::exchange(steps_, 0)));
    state.halo->migrate(state.particles, state.bonds, state.own, state.box,
                        by_id(state, passes.cost(state, steps_a_list_)));
    if (state.neighbours && is_part(state))
      state.neighbours->drop_lists(whole_of(state, places_now(state.particles), count_));
    else if (state.neighbours)
      state.neighbours->drop_lists({});
  }
  state.body_owners.share(state);
  for (const Active& a : effects) a.effect->renumber(state);
  mark_copies(state);
  if (state.neighbours) return;
  const auto x = positions(state.particles);
  shared_at_.clear();
  for (std::size_t i = 0; i < state.particles.size(); ++i) shared_at_.push_back(x.at(i));
}

void mark_copies(State& state) {
  state.ghosts.clear();
  if (!splits(*state.halo)) return;
  const auto id = state.particles[field::id];
  const std::size_t owned = state.halo->owned();
  state.ghosts.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) state.ghosts[i] = static_cast<std::size_t>(id[i]) >= owned;
}

}  // namespace tripoint
