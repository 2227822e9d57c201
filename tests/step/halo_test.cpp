// SPDX-License-Identifier: BSD-3-Clause
// A scene that is shared out: simulations that each hold a slab of it, as threads of one process, against the simulation that
// holds all.
#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <thread>
#include <type_traits>

#include "adapters/scenes.hpp"
#include "particles/moving_lists.hpp"
#include "step/simulation.hpp"

namespace tripoint {
namespace {

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
  /// @param forgets a column that neither copies are handed nor a particle keeps on its way, or bonds, or deformation, as a
  /// defect; empty: none
  SlabHalo(Meeting& meeting, std::size_t rank, std::vector<double> planes, double reach, std::string forgets)
      : meeting_(meeting), rank_(rank), planes_(std::move(planes)), reach_(reach), forgets_(std::move(forgets)) {}

  void migrate(Particles& p, Bonds& bonds, OwnPairs& pairs, const PeriodicBox&) override {
    if (numbers_.empty()) {
      for (int n = 0; n < static_cast<int>(p.size()); ++n)
        numbers_.push_back(n), lists_.push_back(lists_as_numbers(bonds, pairs, static_cast<std::size_t>(n)));
      owned_ = rank_ == 0 ? p.size() : 0;
      longest_list_ = most_list_numbers(bonds, pairs);
    }
    std::vector<std::vector<double>> own, near;  // rows: number and place along x before the columns, lists behind them
    std::vector<double> sent;
    for (std::size_t id = 0; id < owned_; ++id) {
      sent.insert(sent.end(), {static_cast<double>(numbers_[id]), p.position(p.row(id)).x});
      each_column(p, [&](const std::string& name, auto values) {
        sent.push_back(name == forgets_ ? 0.0 : static_cast<double>(values[p.row(id)]));
      });
      std::vector<double> lists = lists_[id];
      lists.resize(longest_list_);
      if (forgets_ == "bonds") std::ranges::fill(lists, 0.0);
      sent.insert(sent.end(), lists.begin(), lists.end());
    }
    std::size_t columns = 2;
    each_column(p, [&](const std::string&, auto) { ++columns; });
    const std::size_t width = columns + longest_list_;
    double reach = std::max(reach_, longest_bond(p, bonds, owned_, {}));
    for (const auto& of : meeting_.exchange(rank_, {reach})) reach = std::max(reach, of[0]);
    for (const auto& of : meeting_.exchange(rank_, sent)) {
      for (std::size_t at = 0; at < of.size(); at += width) {
        const double x = of[at + 1];
        if (x < planes_[rank_] - reach || x >= planes_[rank_ + 1] + reach) continue;
        (x >= planes_[rank_] && x < planes_[rank_ + 1] ? own : near)
            .emplace_back(of.begin() + static_cast<std::ptrdiff_t>(at), of.begin() + static_cast<std::ptrdiff_t>(at + width));
      }
    }
    owned_ = own.size();
    own.insert(own.end(), near.begin(), near.end());
    p = Particles(own.size(), std::vector<FieldInfo>(p.fields()));
    numbers_.clear(), lists_.clear();
    for (std::size_t id = 0; id < own.size(); ++id) {
      numbers_.push_back(static_cast<int>(own[id][0]));
      lists_.emplace_back(own[id].begin() + static_cast<std::ptrdiff_t>(columns), own[id].end());
      std::size_t column = 2;
      each_column(p, [&](const std::string&, auto values) {
        values[id] = static_cast<typename decltype(values)::value_type>(own[id][column++]);
      });
      p[field::id][id] = static_cast<int>(id);
    }
    if (longest_list_ > 0)
      take_lists({owned_, numbers_, [this](std::size_t id) { return std::span<const double>(lists_[id]); }}, bonds, pairs);
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
    for (std::size_t id = owned_; id < numbers_.size(); ++id) std::copy_n(known.at(numbers_[id]), each, &by_id[id * each]);
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
  [[nodiscard]] bool is_first() const override { return rank_ == 0; }
  [[nodiscard]] int number_of(std::size_t id) const { return numbers_[id]; }
  long migrations = 0;

 private:
  template <class Visit>
  static void each_column(Particles& p, Visit visit) {
    p.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
      if constexpr (std::is_arithmetic_v<T>) visit(std::string(field.name), values);
    });
  }
  Meeting& meeting_;
  std::size_t rank_;
  std::vector<double> planes_;
  double reach_;
  std::string forgets_;
  std::size_t owned_ = 0;
  std::size_t longest_list_ = 0;
  std::vector<int> numbers_;
  std::vector<std::vector<double>> lists_;
};

/// A column of jittered water that falls over between walls, which a block falls into.
test::Prepared splash(bool floats_oil = false) {
  Scene s;
  s.spacing = 0.01, s.jitter = 0.2;
  s.gravity = {0, 0, -9.81};
  s.periodic = {false, true, false};
  s.min = Vec3{-0.03, 0.0, -0.03}, s.max = Vec3{0.18, 0.03, 0.2};
  Material water = test::material(1000.0), wood = test::material(500.0);
  water.name = "water", water.viscosity = 1e-3, water.stiffness = 400.0, wood.name = "wood";
  s.materials = {water, test::material(1000.0), wood};
  Body column;
  column.name = "water", column.material = "water", column.phase = Phase::liquid,
  column.shape = test::box({0, 0, 0}, {0.07, 0.03, 0.06});
  Shape tank;
  tank.kind = Shape::Kind::difference;
  tank.of = {test::box({-0.03, 0, -0.03}, {0.18, 0.03, 0.1}), test::box({0, 0, 0}, {0.15, 0.03, 0.2})};
  Body block = test::rigid("block", test::box({0.05, 0.0, 0.065}, {0.09, 0.02, 0.095}), {{0.2, 0, -1.0}, {}});
  block.material = "wood";
  s.bodies = {column, test::rigid("tank", tank, {}, Motion::fixed), block};
  if (floats_oil) {
    Material oil = water;
    oil.name = "oil", oil.density = 700.0;
    s.materials.push_back(oil);
    s.bodies[2] = column;
    s.bodies[2].name = "oil", s.bodies[2].material = "oil", s.bodies[2].shape = test::box({0, 0, 0.06}, {0.07, 0.03, 0.09});
    s.values["interface_weight"] = 1.0;
  }
  return test::prepare(s, 0.02, 1);
}

struct Seen {
  std::vector<Vec3> position, velocity;
  Ledger ledger;
  long migrations = 0;
};

Seen seen_whole(const test::Prepared& p) {
  Simulation whole(p.job.scene, p.initial);
  whole.advance_to(p.job.scene.end_time);
  Seen seen;
  for (std::size_t id = 0; id < p.initial.size(); ++id) {
    seen.position.push_back(whole.world().unwrapped(whole.world().particles.row(id)));
    seen.velocity.push_back(whole.world().particles.velocity(whole.world().particles.row(id)));
  }
  seen.ledger = whole.ledger();
  return seen;
}

Seen seen_shared(const test::Prepared& p, const std::vector<double>& planes, const std::string& forgets = "") {
  const std::size_t count = planes.size() - 1;
  Meeting meeting(count);
  Seen seen;
  seen.position.resize(p.initial.size()), seen.velocity.resize(p.initial.size());
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      SlabHalo halo(meeting, rank, planes, 1.1 * (1.0 + 1e-9) * p.job.scene.support_ratio * p.job.scene.spacing, forgets);
      SimulationOptions options;
      options.halo = &halo;
      Simulation part(p.job.scene, p.initial, options);
      part.advance_to(p.job.scene.end_time);
      const Ledger ledger = part.ledger();
      if (rank == 0) seen.ledger = ledger, seen.migrations = halo.migrations;
      for (std::size_t id = 0; id < halo.owned(); ++id) {
        const std::size_t row = part.world().particles.row(id), number = static_cast<std::size_t>(halo.number_of(id));
        seen.position[number] = part.world().unwrapped(row), seen.velocity[number] = part.world().particles.velocity(row);
      }
    });
  }
  for (std::thread& t : threads) t.join();
  return seen;
}

double greatest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

constexpr double far = 1e9;

class Splash : public testing::TestWithParam<bool> {};
TEST_P(Splash, MovesSharedAsTheWholeDoes) {
  const test::Prepared p = splash(GetParam());
  const Seen whole = seen_whole(p);
  for (const std::vector<double>& planes :
       {std::vector<double>{-far, far}, {-far, 0.055, far}, {-far, 0.021, 0.0634, 0.1, far}}) {
    SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
    const Seen shared = seen_shared(p, planes);
    EXPECT_GT(shared.migrations, 3);
    EXPECT_LT(greatest_difference(whole.position, shared.position), 1e-12)
        << "rounding of sums in another order, over some dozen steps";
    EXPECT_LT(greatest_difference(whole.velocity, shared.velocity), 1e-10);
    ASSERT_EQ(whole.ledger.energy.size(), shared.ledger.energy.size());
    for (const auto& [entry, joule] : whole.ledger.energy) EXPECT_NEAR(joule, shared.ledger.energy.at(entry), 1e-11) << entry;
    EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(Halo, Splash, testing::Bool());

TEST(Halo, AColumnThatIsNotHandedOnIsSeen) {
  const test::Prepared p = splash();
  const Seen whole = seen_whole(p);
  for (const char* column : {"number_density", "force.x", "viscous_force.z"}) {
    const Seen shared = seen_shared(p, {-far, 0.055, far}, column);
    EXPECT_GT(greatest_difference(whole.velocity, shared.velocity), 1e-9) << column;
  }
}

/// A soft bar that is thrown along x and swings, of elastic or of ductile matter, and a block of the same that it meets, if there
/// is to be one.
test::Prepared thrown_bar(bool flows, bool meets, double spin, double bending) {
  Scene s;
  s.spacing = 0.01, s.jitter = 0.1;
  s.values["bending"] = bending;
  Material rubber = test::material(1000.0);
  rubber.young_modulus = 3e5, rubber.poisson_ratio = 0.3, rubber.stiffness = 100.0;
  if (flows) rubber.elastic_limit = 0.001;
  s.materials = {rubber};
  Body bar = test::rigid("bar", test::box({0, 0, 0}, {0.12, 0.04, 0.03}), {{0.5, 0, 0}, {0, 0, spin}});
  bar.phase = Phase::elastic;
  Body block = test::rigid("block", test::box({0.124, 0, 0}, {0.184, 0.05, 0.03}), {{-0.5, 0, 0}, {}});
  block.phase = Phase::elastic;
  s.bodies = {bar};
  if (meets)
    s.bodies.push_back(block);
  else
    s.unguarded = {"inversion", "finite"};
  return test::prepare(s, meets ? 0.01 : 0.02, 1);
}

TEST(Halo, ElasticBodiesThatAreSharedMoveAsTheWholeDoes) {
  for (const bool flows : {false, true}) {
    test::Prepared p = thrown_bar(flows, true, 5.0, flows ? 0.0 : 1.0);
    p.job.scene.values["face_pressure"] = flows ? 1.0 : 0.0;
    const Seen whole = seen_whole(p);
    for (const std::vector<double>& planes : {std::vector<double>{-far, 0.1, far}, {-far, 0.04, 0.13, far}}) {
      SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs" + (flows ? ", plastic" : ""));
      const Seen shared = seen_shared(p, planes);
      EXPECT_GT(shared.migrations, 3);
      EXPECT_LT(greatest_difference(whole.position, shared.position), 1e-12)
          << "rounding of sums in another order, over some hundred steps";
      EXPECT_LT(greatest_difference(whole.velocity, shared.velocity), 1e-10);
      ASSERT_EQ(whole.ledger.energy.size(), shared.ledger.energy.size());
      for (const auto& [entry, joule] : whole.ledger.energy) EXPECT_NEAR(joule, shared.ledger.energy.at(entry), 1e-11) << entry;
      EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, 1e-11);
      EXPECT_NEAR(norm(whole.ledger.angular_momentum - shared.ledger.angular_momentum), 0.0, 1e-11);
    }
  }
}

/// Without contact there are no neighbour lists: what is torn apart by the defect flies on, and no guard ends it.
TEST(Halo, WhatAnElasticParticleDoesNotBringAlongIsSeen) {
  const test::Prepared p = thrown_bar(true, false, 40.0, 0.0);
  const Seen whole = seen_whole(p);
  EXPECT_GT(whole.ledger.energy.at("plastic"), 1e-6);
  const std::vector<double> planes{-far, 0.062, far};
  const Seen right = seen_shared(p, planes);
  EXPECT_GT(right.migrations, 3);
  EXPECT_LT(greatest_difference(whole.velocity, right.velocity), 1e-10);
  for (const char* column :
       {"bonds", "deformation", "elastic_force.x", "shape_inverse.xy", "solid_volume", "plastic_strain.xx"}) {
    const Seen shared = seen_shared(p, planes, column);
    EXPECT_GT(greatest_difference(whole.velocity, shared.velocity), 1e-9) << column;
  }
}

}  // namespace
}  // namespace tripoint
