// SPDX-License-Identifier: BSD-3-Clause
#include "step/sharing.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "world/failure.hpp"

namespace tripoint {
namespace {

bool splits(const Halo& halo) {
  const std::array<bool, 3> split = halo.splits();
  return std::ranges::find(split, true) != split.end();
}

/// Sums of this process over its own particles, body by body.
std::vector<std::vector<double>> body_sums(const World& world) {
  std::vector<std::vector<double>> sums;
  for (const Field<double>& f : world.body_sums) {
    const auto column = world.bodies[f];
    sums.emplace_back(column.begin(), column.end());
  }
  return sums;
}

/// Puts them back; bodies that came to be since have 0. @param sums as body_sums() gave them; none: all are 0
void set_body_sums(World& world, std::vector<std::vector<double>> sums) {
  sums.resize(world.body_sums.size());
  for (std::size_t n = 0; n < sums.size(); ++n) {
    const auto column = world.bodies[world.body_sums[n]];
    sums[n].resize(column.size());
    std::ranges::copy(sums[n], column.begin());
  }
}

/// Positions of the particles when the present lists were made, by number, for each process that holds a part
/// of them. Where a process has no lists, some particles are missing.
std::vector<Vec3> gather_built(const World& world) {
  const std::span<const Vec3> built = world.neighbours->build_positions();
  const std::span<const int> number = world.halo->numbers();
  std::vector<double> own;
  for (std::size_t id = 0; id < world.halo->owned() && built.size() == world.particles.size(); ++id) {
    const Vec3& r = built[world.particles.row(id)];
    own.insert(own.end(), {static_cast<double>(number[id]), r.x, r.y, r.z});
  }
  const std::vector<double> all = world.halo->all_of(own);
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

std::vector<double> by_id(const World& world, const std::vector<double>& by_row) {
  std::vector<double> cost(by_row.size());
  for (std::size_t id = 0; id < cost.size(); ++id) cost[id] = by_row[world.particles.row(id)];
  return cost;
}

/// Places of the last lists, by row of the part that this process has. @param built of the whole, by number
std::vector<Vec3> built_here(const World& world, const std::vector<Vec3>& built) {
  const std::span<const int> number = world.halo->numbers();
  std::vector<Vec3> here(number.size());
  for (std::size_t id = 0; id < here.size(); ++id)
    here[world.particles.row(id)] = built[static_cast<std::size_t>(number[id])];
  return here;
}

/// Facts about the whole scene that the lists of this part need. @param places by row, that they are made at
Whole whole_of(const World& world, std::span<const Vec3> places, std::size_t particles) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Whole whole{{none, none, none}, {-none, -none, -none}, particles, {}, world.halo->owned()};
  for (const Vec3& r : places)
    for (std::size_t a = 0; a < 3; ++a) {
      whole.low[a] = std::min(whole.low[a], r[a]);
      whole.high[a] = std::max(whole.high[a], r[a]);
    }
  const std::vector<double> all =
      world.halo->all_of({whole.low.x, whole.low.y, whole.low.z, whole.high.x, whole.high.y, whole.high.z});
  for (std::size_t k = 0; k < all.size(); k += 6)
    for (std::size_t a = 0; a < 3; ++a) {
      whole.low[a] = std::min(whole.low[a], all[k + a]);
      whole.high[a] = std::max(whole.high[a], all[k + 3 + a]);
    }
  whole.numbers.assign(world.halo->numbers().begin(), world.halo->numbers().end());
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
void refuse_lost(const World& world) {
  constexpr double farthest = 1e100;  // [m], whose square is a number
  const auto x = positions(world.particles);
  for (std::size_t id = 0; id < world.halo->owned(); ++id)
    if (const std::size_t row = world.particles.row(id); !(norm(x.at(row)) <= farthest))
      fail(world, GuardName::finite, row, "position", "drift", "has no finite position");
}

std::vector<Vec3> places_now(const Particles& p) {
  const auto x = positions(p);
  std::vector<Vec3> places(p.size());
  for (std::size_t row = 0; row < p.size(); ++row) places[row] = x.at(row);
  return places;
}

}  // namespace

bool Sharing::is_part(const World& world) const { return world.halo && splits(*world.halo); }

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
  booked_.reset();
  part_.reset();
  count_ = 0;
  if (halo_) halo_->begin_anew();
}

/// Where there are no neighbour lists, as if there were.
bool Sharing::outdated(const World& world) const {
  const Particles& p = world.particles;
  if (world.neighbours) return world.neighbours->outdated(p);
  if (shared_at_.size() != p.size()) return true;
  const double limit = 0.5 * skin_ * world.support();
  const auto x = positions(p);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(norm(x.at(i) - shared_at_[i]) <= limit)) return true;
  return false;
}

void Sharing::gather(World& world, const std::vector<Active>& effects) {
  if (!is_part(world)) return;
  booked_ = {world.booked, body_sums(world)};
  part_ = hold_whole(world);
  gathered_ = {world.bonds.changes(), world.own.changes()};
  for (const Active& a : effects) a.effect->renumber(world);
}

/// Of the whole only the rows that change are asked for their lists.
Sharing::Part Sharing::hold_whole(World& world) const {
  world.body_owners.complete(world);
  world.body_owners = {};
  const std::vector<Vec3> built = world.neighbours ? gather_built(world) : std::vector<Vec3>{};
  WholeScene whole = world.halo->gather(world.particles, world.bonds, world.own);
  Part part{std::exchange(world.particles, std::move(whole.particles)),
            std::exchange(world.bonds, std::move(whole.bonds)),
            std::exchange(world.own, std::move(whole.own)),
            {}};
  world.halo = nullptr;
  world.copies.clear();
  if (!world.neighbours) return part;
  const long rebuilds = world.neighbours->rebuilds();
  Neighbours lists = world.neighbours->anew(world.box);
  lists.list_when_asked();
  std::swap(lists, *world.neighbours);
  if (built.size() == world.particles.size()) {
    part.neighbours = std::move(lists);
    world.neighbours->rebuild_from(world.particles, built, world.time, rebuilds + 1);
  } else {
    world.neighbours->update(world.particles, world.time);
  }
  world.neighbours->mark_own(world.particles, world.own);
  return part;
}

World Sharing::whole(const World& part) const {
  World world = part;
  static_cast<void>(hold_whole(world));
  halo_->add(world.booked.values());
  for (const Field<double>& f : world.body_sums) halo_->add(world.bodies[f]);
  std::string unused;
  for (const StepNumber& one : world.step_numbers.declared())
    if (one.least_of_processes) halo_->take_least(world.step_numbers[one], unused);
  return world;
}

void Sharing::share_out(World& world, const Passes& passes) {
  world.halo = halo_;
  if (!halo_->is_first()) {
    set_body_sums(world, booked_ ? booked_->body_sums : std::vector<std::vector<double>>{});
    if (booked_)
      world.booked = booked_->accounts;
    else
      world.booked.clear();
  }
  booked_.reset();
  if (can_take_back(world))
    take_back(world);
  else
    share_particles(world, passes);
  part_.reset();
}

/// Whether each process can go on with the part that it had, and with its lists. All find the same.
bool Sharing::can_take_back(const World& world) const {
  return part_ && part_->neighbours && world.particles.size() == count_ &&
         world.neighbours->rebuilds() == part_->neighbours->rebuilds() + 1 &&
         !world.neighbours->outdated(world.particles);
}

/// Every particle of the part takes what was decided of it.
void Sharing::take_back(World& world) {
  const Particles whole = std::exchange(world.particles, std::move(part_->particles));
  const std::span<const int> number = halo_->numbers();
  const auto ids = world.particles[field::id];
  const std::vector<int> id(ids.begin(), ids.end());
  std::vector<std::uint32_t> rows;
  for (const int one : id)
    rows.push_back(static_cast<std::uint32_t>(whole.row(static_cast<std::size_t>(number[one]))));
  world.particles.copy(whole, rows);
  std::ranges::copy(id, world.particles[field::id].begin());
  const long rebuilds = world.neighbours->rebuilds();
  world.neighbours = std::move(part_->neighbours);
  world.neighbours->renew(rebuilds + 1);
  if (gathered_ != std::array{world.bonds.changes(), world.own.changes()})
    return halo_->share_lists(world.bonds, world.own);
  world.bonds = std::move(part_->bonds);
  world.own = std::move(part_->own);
}

/// Lists that are not outdated stay. A part then has the lists that one process has of the whole.
void Sharing::share_particles(World& world, const Passes& passes) {
  const bool keeps = world.neighbours && !world.neighbours->outdated(world.particles);
  const std::vector<Vec3> built =
      keeps ? by_id(world.particles, world.neighbours->build_positions()) : std::vector<Vec3>{};
  const bool are_new = count_ != world.particles.size();
  count_ = world.particles.size();
  halo_->share_out(world.particles, world.bonds, world.own, world.box, built,
                   are_new ? by_id(world, passes.cost_at_start(world)) : std::vector<double>{});
  if (!world.neighbours) return;
  const long rebuilds = world.neighbours->rebuilds();
  world.neighbours = world.neighbours->anew(world.box);
  const std::vector<Vec3> here = keeps ? built_here(world, built) : places_now(world.particles);
  if (is_part(world)) world.neighbours->drop_lists(whole_of(world, here, count_));
  if (keeps) world.neighbours->rebuild_from(world.particles, here, world.time, rebuilds + 1);
}

void Sharing::follow(World& world, const std::vector<Active>& effects, const Passes& passes) {
  if (!world.halo) {
    share_out(world, passes);
  } else if (!is_part(world) && world.particles.size() != count_) {
    // One rank holds the whole always: lists may know inflowing particles already
    share_particles(world, passes);
  } else {
    ++steps_;
    if (!any(outdated(world))) return;
    look_together(world, [&] { refuse_lost(world); });
    steps_a_list_ = 0.5 * (steps_a_list_ + static_cast<double>(std::exchange(steps_, 0)));
    world.halo->migrate(world.particles, world.bonds, world.own, world.box,
                        by_id(world, passes.cost(world, steps_a_list_)));
    if (world.neighbours && is_part(world))
      world.neighbours->drop_lists(whole_of(world, places_now(world.particles), count_));
    else if (world.neighbours)
      world.neighbours->drop_lists({});
  }
  world.body_owners.share(world);
  for (const Active& a : effects) a.effect->renumber(world);
  mark_copies(world);
  if (world.neighbours) return;
  const auto x = positions(world.particles);
  shared_at_.clear();
  for (std::size_t i = 0; i < world.particles.size(); ++i) shared_at_.push_back(x.at(i));
}

void mark_copies(World& world) {
  world.copies.clear();
  if (!splits(*world.halo)) return;
  const auto id = world.particles[field::id];
  const std::size_t owned = world.halo->owned();
  world.copies.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) world.copies[i] = static_cast<std::size_t>(id[i]) >= owned;
}

}  // namespace tripoint
