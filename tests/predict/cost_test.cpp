// SPDX-License-Identifier: BSD-3-Clause
// The model of cost against numbers worked out by hand.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "program/predict/cost.hpp"

namespace tripoint::predict {
namespace {

Machine machine() {
  Machine m;
  m.latency = 2e-6;
  m.bandwidth = 1e9;
  m.allreduce = 3e-6;
  m.pack_rate = 4e9;
  m.waiting = 0.1;
  return m;
}

OneRank run(double particles, double pairs, double seconds, double bytes = 0.0) {
  return {particles, pairs, seconds, bytes};
}

TEST(Cost, ThreeRunsGiveThreeTerms) {
  const auto cost = [](double n, double p) { return 1e-5 + 2e-7 * n + 3e-9 * p; };
  const WorkCost w = fit_work({run(1000, 50000, cost(1000, 50000)), run(8000, 450000, cost(8000, 450000)),
                               run(8000, 900000, cost(8000, 900000))});
  EXPECT_NEAR(w.fixed, 1e-5, 1e-11);
  EXPECT_NEAR(w.particle, 2e-7, 1e-13);
  EXPECT_NEAR(w.pair, 3e-9, 1e-15);
  EXPECT_LT(w.worst_misfit, 1e-9);
}

TEST(Cost, OneRunIsAllPairs) {
  const WorkCost w = fit_work({run(1000, 50000, 1e-3)});
  EXPECT_EQ(w.fixed, 0.0);
  EXPECT_EQ(w.particle, 0.0);
  EXPECT_NEAR(w.pair, 2e-8, 1e-18);
}

/// Twice the ranks have half the particles each: what cannot be told apart from these must not be held for
/// fixed.
TEST(Cost, RunsOfOneNumberOfParticlesHaveNothingFixed) {
  const WorkCost w = fit_work({run(8000, 400000, 8e-3), run(8000, 800000, 12e-3)});
  EXPECT_EQ(w.fixed, 0.0);
  EXPECT_NEAR(w.particle, 5e-7, 1e-12);
  EXPECT_NEAR(w.pair, 1e-8, 1e-14);
}

/// Noise that would make a term negative leaves it out and is told as misfit.
TEST(Cost, NoTermIsNegative) {
  const WorkCost w = fit_work({run(1000, 50000, 0.9e-3), run(8000, 400000, 8e-3), run(8000, 800000, 17e-3)});
  EXPECT_GE(w.fixed, 0.0);
  EXPECT_GE(w.particle, 0.0);
  EXPECT_GT(w.pair, 0.0);
  EXPECT_GT(w.worst_misfit, 0.01);
  EXPECT_LT(w.worst_misfit, 0.2);
}

/// What is predicted is nearest to the case itself: where the three cannot all be met, it is met best.
TEST(Cost, TheRunOfTheCaseCountsMost) {
  const WorkCost w = fit_work({run(8000, 400000, 8e-3), run(1000, 50000, 0.9e-3), run(8000, 800000, 17e-3)});
  EXPECT_NEAR(w.seconds(8000, 400000) / 8e-3, 1.0, 0.02);
  EXPECT_GT(w.worst_misfit, 0.03);
}

TEST(Cost, RunsWithoutTimeAreRefused) {
  EXPECT_THROW(static_cast<void>(fit_work({})), InputError);
  EXPECT_THROW(static_cast<void>(fit_work({run(1000, 50000, 0.0)})), InputError);
}

TEST(Cost, MemoryOfOneRankIsWhatItTook) {
  const Memory m =
      fit_memory({run(1e3, 1, 1, 40e6 + 1e3 * 1000.0), run(1e5, 1, 1, 40e6 + 1e5 * 1000.0)}, 300.0);
  EXPECT_NEAR(m.base, 40e6, 1.0);
  EXPECT_EQ(m.scene, 300.0);
  EXPECT_NEAR(m.particle, 700.0, 1e-6);
  EXPECT_NEAR(m.bytes(1e5, 1e5), 40e6 + 1e8, 1.0);
  EXPECT_NEAR(m.bytes(1e5, 2e4), 40e6 + 3e7 + 1.4e7, 1.0);  // of five ranks, with no copies
}

TEST(Cost, OneRankHasEfficiencyOneAndSendsNothing) {
  Shares s;
  s.ranks = {{1000, 0, 50001, 50000}};
  const Prediction p = predict(s, s.ranks[0], {1e-5, 2e-7, 3e-9, 0}, {}, {6, 10, 8, 0.1, 30}, machine());
  EXPECT_EQ(p.efficiency, 1.0);
  EXPECT_NEAR(p.seconds(), 1e-5 + 2e-4 + 1.5e-4, 1e-15);
  EXPECT_EQ(p.messages + p.transport + p.collectives + p.waiting, 0.0);
}

/// Two ranks of 500 with 100 copies each, one with more pairs that it sums over: worked out by hand.
TEST(Cost, ALineIsTheSumOfItsParts) {
  Shares s;
  s.ranks = {{500, 100, 40000, 30000}, {500, 100, 40000, 28000}};
  s.messages = 2.0;
  const Traffic t{6, 10, 8, 0.5, 34};
  const WorkCost cost{0.0, 1e-7, 1e-9, 0.0};
  const Prediction p = predict(s, {1000, 0, 50000, 50000}, cost, {1e6, 100, 200}, t, machine());
  EXPECT_NEAR(p.work, 600e-7 + 30000e-9, 1e-15);
  EXPECT_NEAR(p.messages, (6 + 0.5) * 2 * 2e-6, 1e-15);
  EXPECT_NEAR(p.transport, 100 * 8 * (10 + 0.5 * (34 + 6)) * (1e-9 + 2.0 / 4e9), 1e-15);
  EXPECT_NEAR(p.collectives, 8 * 1 * 3e-6, 1e-15);
  EXPECT_NEAR(p.waiting, 0.1 * p.work, 1e-15);
  EXPECT_NEAR(p.imbalance, 90e-6 / 89e-6, 1e-12);
  EXPECT_NEAR(p.efficiency, 150e-6 / (2 * p.seconds()), 1e-12);
  EXPECT_NEAR(p.bytes, 1e6 + 100 * 1000 + 200 * 600, 1e-6);
}

/// Ten hops for a thousand ranks; a core twice as fast halves the work and nothing else.
TEST(Cost, RanksAndCoresChangeTheirOwnPart) {
  Shares s;
  s.ranks.assign(1000, {500, 100, 40000, 30000});
  s.messages = 6.0;
  Machine fast = machine();
  fast.core_speed = 2.0;
  fast.waiting = 0.0;
  const Prediction p =
      predict(s, {500000, 0, 25e6, 25e6}, {0.0, 1e-7, 1e-9, 0.0}, {}, {6, 10, 8, 0, 34}, fast);
  EXPECT_NEAR(p.collectives, 8 * 10 * 3e-6, 1e-15);
  EXPECT_NEAR(p.work, 45e-6, 1e-15);
  EXPECT_EQ(p.waiting, 0.0);
}

/// Beside others each core is half as fast. One rank has no other beside it.
TEST(Cost, WhereAllCoresHaveWorkEachIsSlower) {
  Shares s;
  s.ranks = {{500, 0, 25000, 25000}, {500, 0, 25000, 25000}};
  const WorkCost cost{0.0, 1e-7, 1e-9, 0.0};
  const Share whole{1000, 0, 50000, 50000};
  Machine still = machine();
  still.waiting = 0.0;
  const Prediction p = predict(s, whole, cost, {}, {}, still, 0.5);
  EXPECT_NEAR(p.work, 2.0 * 75e-6, 1e-15);
  EXPECT_NEAR(p.efficiency, 0.5, 1e-12);
  s.ranks = {whole};
  EXPECT_NEAR(predict(s, whole, cost, {}, {}, still, 0.5).work, 150e-6, 1e-15);
}

}  // namespace
}  // namespace tripoint::predict
