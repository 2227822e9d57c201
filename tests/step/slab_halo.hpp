// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>
#include <type_traits>

#include "adapters/scenes.hpp"
#include "particles/moving_lists.hpp"
#include "solids/objects.hpp"
#include "step/simulation.hpp"

/// A scene that is shared out: simulations that each hold a slab of it, as threads of one process, and the
/// one that holds all.
namespace tripoint::lab {

/// Where threads meet: each leaves numbers, and takes those of all.
class Meeting {
 public:
  explicit Meeting(std::size_t count) : barrier_(static_cast<std::ptrdiff_t>(count)), left_(count) {}
  [[nodiscard]] std::vector<std::vector<double>> exchange(std::size_t rank, std::vector<double> numbers) {
    left_[rank] = std::move(numbers);
    barrier_.arrive_and_wait();
    std::vector<std::vector<double>> all = left_;
    barrier_.arrive_and_wait();
    return all;
  }

 private:
  std::barrier<> barrier_;
  std::vector<std::vector<double>> left_;
};

/// Slabs along x between given planes. Every number goes to everybody; who needs it picks it out.
class SlabHalo : public Halo {
 public:
  /// @param forgets a column that neither ghosts are handed nor a particle keeps on its way, or bonds, or
  /// deformation, as a defect; empty: none
  SlabHalo(Meeting& meeting, std::size_t rank, std::vector<double> planes, double reach, std::string forgets)
      : meeting_(meeting),
        rank_(rank),
        planes_(std::move(planes)),
        reach_(reach),
        forgets_(std::move(forgets)) {}

  /// At first all is the first rank's.
  void share_out(Particles& p, Bonds& bonds, ExcludedPairs& pairs, const PeriodicBox& box,
                 std::span<const Vec3> places, std::span<const double>) override {
    places_ = places;
    ++shares;
    numbers_.clear();
    lists_.clear();
    for (int n = 0; n < static_cast<int>(p.size()); ++n) {
      numbers_.push_back(n);
      lists_.push_back(lists_as_numbers(bonds, pairs, static_cast<std::size_t>(n)));
    }
    owned_ = rank_ == 0 ? p.size() : 0;
    longest_list_ = most_list_numbers(bonds, pairs);
    migrate(p, bonds, pairs, box, {});
    places_ = {};
  }
  [[nodiscard]] std::span<const int> numbers() const override { return numbers_; }
  void share_lists(Bonds& bonds, ExcludedPairs& pairs) override {
    longest_list_ = most_list_numbers(bonds, pairs);
    for (std::size_t id = 0; id < numbers_.size(); ++id)
      lists_[id] = lists_as_numbers(bonds, pairs, static_cast<std::size_t>(numbers_[id]));
    bonds = {};
    pairs = {};
    if (longest_list_ > 0)
      take_lists({owned_, numbers_, [this](std::size_t id) { return std::span<const double>(lists_[id]); }},
                 bonds, pairs);
  }
  WholeScene gather(const Particles& p, const Bonds&, const ExcludedPairs&) override {
    std::vector<Row> rows;
    for (const std::vector<double>& of : meeting_.exchange(rank_, own_rows(p)))
      for (std::size_t at = 0; at < of.size(); at += width(p))
        rows.emplace_back(of.begin() + static_cast<std::ptrdiff_t>(at),
                          of.begin() + static_cast<std::ptrdiff_t>(at + width(p)));
    std::ranges::sort(rows, {}, [](const Row& row) { return row[0]; });
    WholeScene whole;
    whole.particles = particles_of(rows, p.fields());
    Share all{rows.size(), {}, [&](std::size_t id) { return lists_in(rows[id]); }};
    for (std::size_t n = 0; n < rows.size(); ++n) all.number.push_back(static_cast<int>(n));
    if (longest_list_ > 0) take_lists(all, whole.bonds, whole.own);
    ++gatherings;
    return whole;
  }
  void migrate(Particles& p, Bonds& bonds, ExcludedPairs& pairs, const PeriodicBox&,
               std::span<const double>) override {
    std::vector<Row> own, near;
    // amply
    double reach = std::max(reach_, longest_bond(p, bonds, owned_, {}) + (places_.empty() ? 0.0 : reach_));
    for (const auto& of : meeting_.exchange(rank_, {reach})) reach = std::max(reach, of[0]);
    for (const auto& of : meeting_.exchange(rank_, own_rows(p))) {
      for (std::size_t at = 0; at < of.size(); at += width(p)) {
        const double x = places_.empty() ? of[at + 1] : places_[static_cast<std::size_t>(of[at])].x;
        if (x < planes_[rank_] - reach || x >= planes_[rank_ + 1] + reach) continue;
        (x >= planes_[rank_] && x < planes_[rank_ + 1] ? own : near)
            .emplace_back(of.begin() + static_cast<std::ptrdiff_t>(at),
                          of.begin() + static_cast<std::ptrdiff_t>(at + width(p)));
      }
    }
    owned_ = own.size();
    own.insert(own.end(), near.begin(), near.end());
    p = particles_of(own, p.fields());
    numbers_.clear();
    lists_.clear();
    for (const Row& row : own) {
      numbers_.push_back(static_cast<int>(row[0]));
      lists_.emplace_back(lists_in(row).begin(), lists_in(row).end());
    }
    bonds = {};
    pairs = {};
    if (longest_list_ > 0)
      take_lists({owned_, numbers_, [this](std::size_t id) { return std::span<const double>(lists_[id]); }},
                 bonds, pairs);
    ++migrations;
  }
  [[nodiscard]] std::array<bool, 3> splits() const override { return {true, false, false}; }
  [[nodiscard]] std::size_t owned() const override { return owned_; }
  void refresh(Particles& p, std::span<const Field<double>* const> columns) override {
    std::vector<double> by_id(p.size());
    for (const Field<double>* f : columns) {
      const auto values = p[*f];
      for (std::size_t id = 0; id < p.size(); ++id) by_id[id] = values[p.row(id)];
      refresh(by_id, 1);
      if (f->name == forgets_) continue;
      for (std::size_t id = 0; id < p.size(); ++id) values[p.row(id)] = by_id[id];
    }
  }
  void refresh(std::span<double> by_id, std::size_t each) override {
    std::vector<double> sent;
    for (std::size_t id = 0; id < owned_; ++id) {
      sent.push_back(numbers_[id]);
      for (std::size_t k = 0; k < each; ++k) sent.push_back(by_id[id * each + k]);
    }
    const auto all = meeting_.exchange(rank_, sent);
    std::map<int, const double*> known;
    for (const auto& of : all)
      for (std::size_t at = 0; at < of.size(); at += each + 1) known[static_cast<int>(of[at])] = &of[at + 1];
    if (forgets_ == "deformation" && each > 1) return;
    for (std::size_t id = owned_; id < numbers_.size(); ++id)
      std::copy_n(known.at(numbers_[id]), each, &by_id[id * each]);
  }
  void add(std::span<double> numbers) override {
    const auto all = meeting_.exchange(rank_, {numbers.begin(), numbers.end()});
    std::ranges::fill(numbers, 0.0);
    for (const auto& of : all)
      for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] += of[n];
  }
  void take_least(double& number, std::string&) override {
    for (const auto& of : meeting_.exchange(rank_, {number})) number = std::min(number, of[0]);
  }
  [[nodiscard]] std::vector<double> all_of(const std::vector<double>& own) override {
    std::vector<double> all;
    for (const auto& of : meeting_.exchange(rank_, own)) all.insert(all.end(), of.begin(), of.end());
    return all;
  }
  [[nodiscard]] std::vector<std::vector<double>> exchange(
      const std::vector<std::vector<double>>& to) override {
    std::vector<double> sent;  // for each rank how many numbers, and these
    for (const std::vector<double>& one : to) {
      sent.push_back(static_cast<double>(one.size()));
      sent.insert(sent.end(), one.begin(), one.end());
    }
    std::vector<std::vector<double>> here;
    for (const std::vector<double>& from : meeting_.exchange(rank_, sent)) {
      const double* next = from.data();
      for (std::size_t before = 0; before < rank_; ++before) next += 1 + static_cast<std::size_t>(*next);
      here.emplace_back(next + 1, next + 1 + static_cast<std::size_t>(*next));
    }
    return here;
  }
  [[nodiscard]] std::size_t processes() const override { return planes_.size() - 1; }
  [[nodiscard]] std::size_t process() const override { return rank_; }
  [[nodiscard]] std::size_t owners_above() const override { return bodies_of_all; }
  [[nodiscard]] bool is_first() const override { return rank_ == 0; }
  std::size_t bodies_of_all = 1000;
  long migrations = 0, gatherings = 0, shares = 0;

 private:
  using Row = std::vector<double>;  ///< number and place along x, the columns, and lists behind them
  template <class P, class Visit>
  static void each_column(P& p, Visit visit) {
    p.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
      if constexpr (std::is_arithmetic_v<T>) visit(std::string(field.name), values);
    });
  }
  static std::size_t columns(const Particles& p) {
    std::size_t count = 2;
    each_column(p, [&](const std::string&, auto) { ++count; });
    return count;
  }
  [[nodiscard]] std::size_t width(const Particles& p) const { return columns(p) + longest_list_; }
  [[nodiscard]] std::span<const double> lists_in(const Row& row) const {
    return std::span<const double>(row).last(longest_list_);
  }
  [[nodiscard]] std::vector<double> own_rows(const Particles& p) const {
    std::vector<double> rows;
    for (std::size_t id = 0; id < owned_; ++id) {
      rows.insert(rows.end(), {static_cast<double>(numbers_[id]), p.position(p.row(id)).x});
      each_column(p, [&](const std::string& name, auto values) {
        rows.push_back(name == forgets_ ? 0.0 : static_cast<double>(values[p.row(id)]));
      });
      std::vector<double> lists = lists_[id];
      lists.resize(longest_list_);
      if (forgets_ == "bonds") std::ranges::fill(lists, 0.0);
      rows.insert(rows.end(), lists.begin(), lists.end());
    }
    return rows;
  }
  static Particles particles_of(const std::vector<Row>& rows, const std::vector<FieldInfo>& fields) {
    Particles p(rows.size(), fields);
    for (std::size_t id = 0; id < rows.size(); ++id) {
      std::size_t column = 2;
      each_column(p, [&](const std::string&, auto values) {
        values[id] = static_cast<typename decltype(values)::value_type>(rows[id][column++]);
      });
      p[field::id][id] = static_cast<int>(id);
    }
    return p;
  }

  Meeting& meeting_;
  std::size_t rank_;
  std::vector<double> planes_;
  double reach_;
  std::string forgets_;
  std::size_t owned_ = 0;
  std::size_t longest_list_ = 0;
  std::span<const Vec3> places_;  ///< to share out by, for now
  std::vector<int> numbers_;
  std::vector<std::vector<double>> lists_;
};

/// What is compared of the end of a run; particles by number.
struct Seen {
  std::vector<Vec3> position, velocity;
  std::vector<int> body, phase;
  std::vector<std::string> names;  ///< of bodies
  std::vector<int> alive;          ///< likewise
  std::vector<Vec3> centre, spin;  ///< likewise, as the first process has them [m], [rad/s]
  /// How many each process keeps, where bodies have owners; in no order
  std::vector<std::size_t> kept_bodies;
  std::size_t objects = 0;
  Ledger ledger;
  Checkpoint kept;  ///< at half time, where one was asked for
  long migrations = 0, gatherings = 0, shares = 0;
};

inline void see_particle(Seen& seen, std::size_t number, const State& state, std::size_t row) {
  if (seen.position.size() <= number) {
    seen.position.resize(number + 1);
    seen.velocity.resize(number + 1);
    seen.body.resize(number + 1);
    seen.phase.resize(number + 1);
  }
  seen.position[number] = state.unwrapped(row);
  seen.velocity[number] = state.particles.velocity(row);
  seen.body[number] = state.particles[field::body][row];
  seen.phase[number] = state.particles[field::phase][row];
}

inline void see_bodies(Seen& seen, const State& state) {
  seen.names = state.body_names;
  if (state.bodies.size() == 0) return;
  const auto alive = state.bodies[field::body_alive];
  seen.alive.assign(alive.begin(), alive.end());
  const auto centre = state.bodies[field::body_centre], spin = state.bodies[field::body_angular_velocity];
  seen.centre.assign(centre.begin(), centre.end());
  seen.spin.assign(spin.begin(), spin.end());
}

/// @param from a checkpoint to go on from; null: none
inline Seen seen_whole(const test::Prepared& p, const Checkpoint* from = nullptr) {
  Simulation whole =
      from ? Simulation(p.job.scene, p.initial, {}, *from) : Simulation(p.job.scene, p.initial);
  Seen seen;
  if (!from) {
    whole.advance_to(0.5 * p.job.scene.end_time);
    seen.kept = whole.checkpoint();
  }
  whole.advance_to(p.job.scene.end_time);
  const State& state = whole.state();
  for (std::size_t id = 0; id < state.particles.size(); ++id)
    see_particle(seen, id, state, state.particles.row(id));
  see_bodies(seen, state);
  seen.objects = count_objects(state);
  seen.ledger = whole.ledger();
  return seen;
}

/// @param forgets,from,owners_above as of SlabHalo, seen_whole() and Halo
inline Seen seen_shared(const test::Prepared& p, const std::vector<double>& planes,
                        const std::string& forgets = "", const Checkpoint* from = nullptr,
                        std::size_t owners_above = 1000) {
  const std::size_t count = planes.size() - 1;
  Meeting meeting(count);
  Seen seen;
  std::mutex alone;
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      SlabHalo halo(meeting, rank, planes,
                    1.1 * (1.0 + 1e-9) * p.job.scene.support_ratio * p.job.scene.spacing, forgets);
      halo.bodies_of_all = owners_above;
      SimulationOptions options;
      options.halo = &halo;
      Simulation part = from ? Simulation(p.job.scene, p.initial, options, *from)
                             : Simulation(p.job.scene, p.initial, options);
      if (!from) part.advance_to(0.5 * p.job.scene.end_time);
      const Checkpoint kept = part.checkpoint();
      part.advance_to(p.job.scene.end_time);
      const Ledger ledger = part.ledger();
      part.complete_bodies();
      const std::size_t objects = count_objects(part.state());
      const std::lock_guard lock(alone);
      if (part.state().body_owners.any()) seen.kept_bodies.push_back(part.state().body_owners.kept().size());
      if (rank == 0) {
        seen.ledger = ledger;
        seen.objects = objects;
        seen.kept = kept;
        seen.migrations = halo.migrations;
        seen.gatherings = halo.gatherings;
        seen.shares = halo.shares;
        see_bodies(seen, part.state());
      }
      for (std::size_t id = 0; id < halo.owned(); ++id)
        see_particle(seen, static_cast<std::size_t>(halo.numbers()[id]), part.state(),
                     part.state().particles.row(id));
    });
  }
  for (std::thread& t : threads) t.join();
  return seen;
}

inline double greatest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

/// Of sums of the ledger, in another order; of 1 in the scenes' own units
inline constexpr double rounding = 1e-10;

inline void expect_same(const Seen& whole, const Seen& shared) {
  ASSERT_EQ(whole.position.size(), shared.position.size());
  ASSERT_EQ(whole.centre.size(), shared.centre.size());
  EXPECT_EQ(greatest_difference(whole.position, shared.position), 0.0)
      << "every sum that moves something has its order";
  EXPECT_EQ(greatest_difference(whole.velocity, shared.velocity), 0.0);
  EXPECT_EQ(whole.phase, shared.phase);
  EXPECT_EQ(whole.body, shared.body);
  EXPECT_EQ(whole.names, shared.names);
  EXPECT_EQ(whole.alive, shared.alive);
  EXPECT_EQ(greatest_difference(whole.centre, shared.centre), 0.0) << "the first process knows all bodies";
  EXPECT_EQ(greatest_difference(whole.spin, shared.spin), 0.0);
  EXPECT_EQ(whole.objects, shared.objects);
  double size = 0.0;
  for (const auto& [entry, joule] : whole.ledger.energy) size = std::max(size, std::abs(joule));
  for (const auto& [entry, joule] : whole.ledger.energy)
    EXPECT_NEAR(joule, shared.ledger.energy.at(entry), rounding * size) << entry;
  EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, rounding);
  EXPECT_NEAR(norm(whole.ledger.angular_momentum - shared.ledger.angular_momentum), 0.0, rounding);
}

inline constexpr double far = 1e9;

}  // namespace tripoint::lab
