// SPDX-License-Identifier: BSD-3-Clause
#include "solids/objects.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "state/body_table.hpp"

namespace tripoint {
namespace {

/// Points on a line, one spacing apart, all of one material; bonds are made by hand.
struct Line {
  State state;

  explicit Line(std::size_t count, bool melts = true) {
    Material m;
    m.name = "stuff";
    if (melts) m.t_melt = 300.0;
    state.scene.materials = {m};
    state.scene.spacing = 1.0;
    std::vector<FieldInfo> fields = common_fields(false);
    const auto table = body_table_fields();
    fields.insert(fields.end(), table.begin(), table.end());
    state.particles = Particles(count, fields);
    state.bodies = Columns(0, Per::body, fields);
    for (std::size_t i = 0; i < count; ++i) {
      positions(state.particles).set(i, {static_cast<double>(i), 0.0, 0.0});
      state.particles[field::body][i] = -1;
      state.particles[field::source][i] = -1;
    }
  }
  /// A body of ids first..last, bonded within `reach`, with all of them excluded pairs.
  std::size_t add(std::string_view name, std::uint32_t first, std::uint32_t last, double reach,
                  Phase phase = Phase::elastic) {
    const std::size_t b = add_body(state, name, phase);
    state.bodies[field::body_source][b] = static_cast<int>(b);
    for (std::uint32_t i = first; i <= last; ++i) {
      state.particles[field::body][i] = static_cast<int>(b);
      state.particles[field::source][i] = static_cast<int>(b);
      state.particles[field::phase][i] = static_cast<int>(phase);
      for (std::uint32_t j = first; j < i; ++j) {
        if (i - j <= reach) bond(j, i);
        make_own(state.own, j, i, 1.0);
      }
    }
    return b;
  }
  void bond(std::uint32_t i, std::uint32_t j) {
    const double d = static_cast<double>(j) - static_cast<double>(i);
    Bond of_i, of_j;
    of_i.x = {-d, 0.0, 0.0};
    of_j.x = {d, 0.0, 0.0};
    connect(state.bonds, i, j, of_i, of_j);
  }
  void cut(std::uint32_t i, std::uint32_t j) {
    disconnect(state.bonds, i, [&](const Bond& b) { return b.other == j; });
  }
  /// The particle becomes liquid, as phase change does it.
  void melt(std::uint32_t i) {
    disconnect(state.bonds, i, [](const Bond&) { return true; });
    const std::vector<ExcludedPair> pairs(state.own.of(i).begin(), state.own.of(i).end());
    for (const ExcludedPair& p : pairs) end_own(state.own, i, p.other);
    state.particles[field::body][i] = -1;
    state.particles[field::phase][i] = 0;
  }
  std::vector<int> bodies() const {
    return {state.particles[field::body].begin(), state.particles[field::body].end()};
  }
  bool bonded(std::uint32_t i, std::uint32_t j) const {
    return std::ranges::any_of(state.bonds.of(i), [&](const Bond& b) { return b.other == j; });
  }
};

TEST(Regroup, CutsABarAtAMoltenParticleAndLongBondsDoNotBridgeIt) {
  Line line(9);
  line.add("bar", 0, 8, 2.0);
  line.melt(3);
  std::vector<std::uint32_t> told;
  regroup(line.state, {{0}, {}}, [&](std::uint32_t id) {
    EXPECT_TRUE(line.bonded(2, 4));  // still as before
    told.push_back(id);
  });
  // Five keep the row, three are new
  EXPECT_EQ(line.bodies(), (std::vector<int>{1, 1, 1, -1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(line.state.body_names, (std::vector<std::string>{"bar", "bar.1"}));
  EXPECT_FALSE(line.bonded(2, 4));
  EXPECT_FALSE(are_own(line.state.own, 0, 8));
  EXPECT_TRUE(are_own(line.state.own, 0, 2));
  sort_once(told);
  EXPECT_EQ(told, (std::vector<std::uint32_t>{2, 4}));
  EXPECT_EQ(line.state.change.regrouped, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(line.state.change.relisted, (std::vector<std::uint32_t>{0, 1, 2, 4, 5, 6, 7, 8}));
  EXPECT_EQ(line.state.change.bodies, (std::vector<std::size_t>{0, 1}));
}

TEST(Regroup, ChangesNothingWhereAllStillHoldsTogether) {
  Line line(6);
  line.add("bar", 0, 5, 2.0);
  line.cut(1, 3);  // a bond of two spacings: 1-2-3 is left
  regroup(line.state, {{0}, {}}, [](std::uint32_t) { FAIL(); });
  EXPECT_TRUE(line.state.change.empty());
  EXPECT_EQ(line.state.bodies.size(), 1u);
}

TEST(Regroup, NamesThePartsByTheirLowestIdAndGivesEqualsToTheLowest) {
  Line line(6);
  line.add("bar", 0, 5, 1.0);
  line.cut(1, 2);
  line.cut(3, 4);
  regroup(line.state, {{0}, {}}, {});
  EXPECT_EQ(line.bodies(), (std::vector<int>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(line.state.body_names, (std::vector<std::string>{"bar", "bar.1", "bar.2"}));
  line.state.change = {};
  line.cut(4, 5);
  regroup(line.state, {{2}, {}}, {});
  EXPECT_EQ(line.state.body_names.back(), "bar.2.1");
  EXPECT_EQ(line.state.change.regrouped, (std::vector<std::uint32_t>{5}));
}

TEST(Regroup, UnitesTwoBodiesOnlyThroughWhatFroze) {
  Line line(7);
  line.add("left", 0, 2, 1.0);
  line.add("right", 4, 6, 1.0);
  line.bond(2, 4);  // a joint of two bodies that were solid before
  regroup(line.state, {{0, 1}, {}}, {});
  EXPECT_EQ(line.bodies(), (std::vector<int>{0, 0, 0, -1, 1, 1, 1}));
  EXPECT_FALSE(line.bonded(2, 4)) << "longer than the joining distance";
  line.state.particles[field::phase][3] = static_cast<int>(Phase::elastic);
  line.bond(2, 3);
  line.bond(3, 4);
  line.state.change = {};
  regroup(line.state, {{0, 1}, {3}}, {});
  EXPECT_EQ(line.bodies(), std::vector<int>(7, 0));
  EXPECT_FALSE(is_alive(line.state, 1));
  EXPECT_EQ(line.state.change.bodies, (std::vector<std::size_t>{0, 1}));
}

TEST(Regroup, LetsRigidAndDeformableBeTwoBodiesOfOneObject) {
  Line line(6);
  line.add("rigid", 0, 2, 2.0, Phase::rigid);
  line.add("elastic", 3, 5, 2.0);
  for (const auto& [i, j] : {std::pair{2u, 3u}, {1u, 3u}, {2u, 4u}}) line.bond(i, j);
  regroup(line.state, {{0, 1}, {}}, {});
  EXPECT_TRUE(line.state.change.empty());
  EXPECT_EQ(count_objects(line.state), 1u);
  line.melt(2);
  regroup(line.state, {{0, 1}, {}}, {});
  EXPECT_FALSE(line.bonded(1, 3)) << "a joint ends with its last short bond";
  EXPECT_EQ(count_objects(line.state), 2u);
}

TEST(Regroup, MakesABodyOfWhatFreezesAloneAndNamesItAfterItsMaterial) {
  Line line(3);
  line.state.particles[field::phase][1] = static_cast<int>(Phase::rigid);
  regroup(line.state, {{}, {1}}, {});
  EXPECT_EQ(line.bodies(), (std::vector<int>{-1, 0, -1}));
  EXPECT_EQ(line.state.body_names.at(0), "stuff.1");
  EXPECT_TRUE(is_rigid(line.state, 0));
}

TEST(Regroup, LeavesTheRowToWhatTheSceneGaveADrivenBody) {
  Line line(9);
  line.add("plate", 0, 1, 1.0, Phase::rigid);
  line.state.bodies[field::body_motion][0] = static_cast<int>(Motion::fixed);
  std::vector<std::uint32_t> ice(7);
  std::iota(ice.begin(), ice.end(), 2u);
  for (const std::uint32_t i : ice) {
    line.state.particles[field::phase][i] = static_cast<int>(Phase::rigid);
    line.bond(i - 1, i);
  }
  regroup(line.state, {{0}, ice}, {});
  EXPECT_EQ(line.bodies(), std::vector<int>(9, 0));
  line.cut(1, 2);
  regroup(line.state, {{0}, {}}, {});
  EXPECT_EQ(line.bodies(), (std::vector<int>{0, 0, 1, 1, 1, 1, 1, 1, 1}));  // seven leave the two
  EXPECT_EQ(line.state.bodies[field::body_motion][1], static_cast<int>(Motion::free));
}

TEST(Regroup, NeverUnitesTwoDrivenBodies) {
  Line line(3);
  for (const std::uint32_t i : {0u, 2u}) {
    const std::size_t b = line.add("plate", i, i, 1.0, Phase::rigid);
    line.state.bodies[field::body_motion][b] = static_cast<int>(Motion::fixed);
  }
  line.state.particles[field::phase][1] = static_cast<int>(Phase::rigid);
  line.bond(0, 1);
  line.bond(1, 2);
  regroup(line.state, {{0, 1}, {1}}, {});
  EXPECT_EQ(line.bodies(), (std::vector<int>{0, 0, 1}));
}

TEST(Regroup, HoldsARigidBodyThatNeverMeltsTogetherWithoutBonds) {
  Line line(4, false);
  line.add("stone", 0, 3, 0.0, Phase::rigid);
  regroup(line.state, {{0}, {}}, {});
  EXPECT_EQ(line.bodies(), std::vector<int>(4, 0));
}

TEST(Regroup, BuriesABodyThatMeltedWholly) {
  Line line(2);
  line.add("drop", 0, 1, 1.0);
  line.melt(0);
  line.melt(1);
  regroup(line.state, {{0}, {}}, {});
  EXPECT_FALSE(is_alive(line.state, 0));
  EXPECT_EQ(line.state.change.bodies, (std::vector<std::size_t>{0}));
  EXPECT_EQ(count_objects(line.state), 0u);
}

}  // namespace
}  // namespace tripoint
