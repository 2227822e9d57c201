// SPDX-License-Identifier: BSD-3-Clause
// A scene that is shared out: simulations that each hold a slab of it, as threads of one process, against the simulation that holds all.
#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <thread>
#include <type_traits>

#include "adapters/scenes.hpp"
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
  /// @param forgets a column that copies are not handed, as a defect; empty: none
  SlabHalo(Meeting& meeting, std::size_t rank, std::vector<double> planes, double reach, std::string forgets) : meeting_(meeting), rank_(rank), planes_(std::move(planes)), reach_(reach), forgets_(std::move(forgets)) {}

  void migrate(Particles& p, const PeriodicBox&) override {
    if (numbers_.empty()) {
      for (int n = 0; n < static_cast<int>(p.size()); ++n) numbers_.push_back(n);
      owned_ = rank_ == 0 ? p.size() : 0;
    }
    std::vector<std::vector<double>> own, near;  // rows: number and place along x before the columns
    std::vector<double> sent;
    for (std::size_t id = 0; id < owned_; ++id) {
      sent.insert(sent.end(), {static_cast<double>(numbers_[id]), p.position(p.row(id)).x});
      each_column(p, [&](auto values) { sent.push_back(static_cast<double>(values[p.row(id)])); });
    }
    std::size_t width = 2;
    each_column(p, [&](auto) { ++width; });
    for (const auto& of : meeting_.exchange(rank_, sent)) {
      for (std::size_t at = 0; at < of.size(); at += width) {
        const double x = of[at + 1];
        if (x < planes_[rank_] - reach_ || x >= planes_[rank_ + 1] + reach_) continue;
        (x >= planes_[rank_] && x < planes_[rank_ + 1] ? own : near).emplace_back(of.begin() + static_cast<std::ptrdiff_t>(at), of.begin() + static_cast<std::ptrdiff_t>(at + width));
      }
    }
    owned_ = own.size();
    own.insert(own.end(), near.begin(), near.end());
    p = Particles(own.size(), std::vector<FieldInfo>(p.fields()));
    numbers_.clear();
    for (std::size_t id = 0; id < own.size(); ++id) {
      numbers_.push_back(static_cast<int>(own[id][0]));
      std::size_t column = 2;
      each_column(p, [&](auto values) { values[id] = static_cast<typename decltype(values)::value_type>(own[id][column++]); });
      p[field::id][id] = static_cast<int>(id);
    }
    ++migrations;
  }
  [[nodiscard]] std::array<bool, 3> splits() const override { return {true, false, false}; }
  [[nodiscard]] std::size_t owned() const override { return owned_; }
  void refresh(Particles& p, std::span<const Field<double>* const> columns) override {
    std::vector<double> by_id(p.size());
    for (const Field<double>* f : columns) {
      const auto values = p[*f];
      for (std::size_t id = 0; id < p.size(); ++id) by_id[id] = values[p.row(id)];
      refresh(by_id);
      if (f->name == forgets_) continue;
      for (std::size_t id = 0; id < p.size(); ++id) values[p.row(id)] = by_id[id];
    }
  }
  void refresh(std::span<double> by_id) override {
    std::vector<double> sent;
    for (std::size_t id = 0; id < owned_; ++id) sent.insert(sent.end(), {static_cast<double>(numbers_[id]), by_id[id]});
    std::map<int, double> known;
    for (const auto& of : meeting_.exchange(rank_, sent))
      for (std::size_t at = 0; at < of.size(); at += 2) known[static_cast<int>(of[at])] = of[at + 1];
    for (std::size_t id = owned_; id < numbers_.size(); ++id) by_id[id] = known.at(numbers_[id]);
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
    p.for_each([&]<class T>(const FieldInfo&, std::span<T> values) {
      if constexpr (std::is_arithmetic_v<T>) visit(values);
    });
  }
  Meeting& meeting_;
  std::size_t rank_;
  std::vector<double> planes_;
  double reach_;
  std::string forgets_;
  std::size_t owned_ = 0;
  std::vector<int> numbers_;
};

/// A column of jittered water that falls over between walls, which a block falls into.
test::Prepared splash() {
  Scene s;
  s.spacing = 0.01, s.jitter = 0.2;
  s.gravity = {0, 0, -9.81};
  s.periodic = {false, true, false};
  s.min = Vec3{-0.03, 0.0, -0.03}, s.max = Vec3{0.18, 0.03, 0.2};
  Material water = test::material(1000.0), wood = test::material(500.0);
  water.name = "water", water.viscosity = 1e-3, water.stiffness = 400.0, wood.name = "wood";
  s.materials = {water, test::material(1000.0), wood};
  Body column;
  column.name = "water", column.material = "water", column.phase = Phase::liquid, column.shape = test::box({0, 0, 0}, {0.07, 0.03, 0.06});
  Shape tank;
  tank.kind = Shape::Kind::difference;
  tank.of = {test::box({-0.03, 0, -0.03}, {0.18, 0.03, 0.1}), test::box({0, 0, 0}, {0.15, 0.03, 0.2})};
  Body block = test::rigid("block", test::box({0.05, 0.0, 0.065}, {0.09, 0.02, 0.095}), {{0.2, 0, -1.0}, {}});
  block.material = "wood";
  s.bodies = {column, test::rigid("tank", tank, {}, Motion::fixed), block};
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

TEST(Halo, ASharedSceneMovesAsTheWholeDoes) {
  const test::Prepared p = splash();
  const Seen whole = seen_whole(p);
  for (const std::vector<double>& planes : {std::vector<double>{-far, far}, {-far, 0.055, far}, {-far, 0.021, 0.0634, 0.1, far}}) {
    SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
    const Seen shared = seen_shared(p, planes);
    EXPECT_GT(shared.migrations, 3);
    EXPECT_LT(greatest_difference(whole.position, shared.position), 1e-12) << "rounding of sums in another order, over some dozen steps";
    EXPECT_LT(greatest_difference(whole.velocity, shared.velocity), 1e-10);
    ASSERT_EQ(whole.ledger.energy.size(), shared.ledger.energy.size());
    for (const auto& [entry, joule] : whole.ledger.energy) EXPECT_NEAR(joule, shared.ledger.energy.at(entry), 1e-11) << entry;
    EXPECT_NEAR(norm(whole.ledger.momentum - shared.ledger.momentum), 0.0, 1e-11);
  }
}

TEST(Halo, AColumnThatIsNotHandedOnIsSeen) {
  const test::Prepared p = splash();
  const Seen whole = seen_whole(p);
  for (const char* column : {"number_density", "force.x", "viscous_force.z"}) {
    const Seen shared = seen_shared(p, {-far, 0.055, far}, column);
    EXPECT_GT(greatest_difference(whole.velocity, shared.velocity), 1e-9) << column;
  }
}

}  // namespace
}  // namespace tripoint
