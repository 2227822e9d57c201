// SPDX-License-Identifier: BSD-3-Clause
// Bodies of a shared scene that have owners: each process moves those alone that it has a part of, and those
// that it owns.
#include <gtest/gtest.h>

#include <numeric>

#include "adapters/changing_scenes.hpp"
#include "step/slab_halo.hpp"

namespace tripoint {
namespace {

using lab::expect_same, lab::far, lab::Seen, lab::seen_shared, lab::seen_whole;

constexpr std::size_t all_have_owners = 0;

/// A row of blocks that turn and fly along it, to both sides and at several speeds, so that they meet and
/// cross what is cut; with a driven one and one that stands.
test::Prepared flying_blocks(int along = 12, int across = 3) {
  Scene s;
  s.spacing = 0.01;
  s.gravity = {0, 0, -9.81};
  Material stone = test::material(2000.0);
  stone.stiffness = 100.0;
  s.materials = {stone};
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double x = 0.03 * i, y = 0.03 * j;
      const double speed = (i % 2 == 0 ? 1.0 : -1.0) * (0.5 + 0.4 * j);
      s.bodies.push_back(test::rigid("block " + std::to_string(i) + " " + std::to_string(j),
                                     test::box({x, y, 0}, {x + 0.02, y + 0.02, 0.02}),
                                     {{speed, 0, 0}, {3.0, 2.0 + i, 5.0 - j}}));
    }
  s.bodies.push_back(test::rigid("ram", test::box({-0.08, 0, 0}, {-0.04, 0.08, 0.02}), {{2.0, 0, 0}, {}},
                                 Motion::prescribed));
  s.bodies.push_back(test::rigid("wall", test::box({0.4, 0, -0.02}, {0.43, 0.08, 0.04}), {}, Motion::fixed));
  return test::prepare(s, 0.1, 1);
}

TEST(Halo, BodiesWithOwnersMoveAsTheWholeDoes) {
  const test::Prepared p = flying_blocks();
  const Seen whole = seen_whole(p);
  std::size_t crossed = 0;
  for (std::size_t id = 0; id < p.initial.size(); ++id)
    crossed += (p.initial.position[id].x < 0.185) != (whole.position[id].x < 0.185) ? 1 : 0;
  ASSERT_GE(crossed, 8u * 3u) << "some blocks go from one half to the other";
  for (const std::vector<double>& planes : {std::vector<double>{-far, far},
                                            {-far, 0.185, far},
                                            {-far, 0.06, 0.13, 0.25, far},
                                            {-far, -0.5, 0.185, far}}) {
    SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
    const Seen shared = seen_shared(p, planes, "", nullptr, all_have_owners);
    EXPECT_GT(shared.migrations, 3);
    expect_same(whole, shared);
    EXPECT_EQ(shared.kept_bodies.size(), planes.size() == 2 ? 0 : planes.size() - 1)
        << "one process alone keeps all";
  }
}

/// Those that keep none take part in what all do together.
TEST(Halo, AProcessMayKeepNoBody) {
  const test::Prepared p = flying_blocks(1, 1);
  const Seen shared = seen_shared(p, {-far, -0.1, 0.0, 0.3, 0.35, far}, "", nullptr, all_have_owners);
  expect_same(seen_whole(p), shared);
  EXPECT_GE(std::ranges::count(shared.kept_bodies, 0u), 1);
}

TEST(Halo, OfManyBodiesEachProcessKeepsItsShare) {
  const test::Prepared p = flying_blocks();
  const auto moving = p.job.scene.bodies.size() - 1;
  const Seen shared = seen_shared(p, {-far, 0.06, 0.13, 0.25, far}, "", nullptr, all_have_owners);
  const std::size_t kept =
      std::accumulate(shared.kept_bodies.begin(), shared.kept_bodies.end(), std::size_t{0});
  EXPECT_GE(kept, moving) << "each has an owner";
  EXPECT_LT(*std::ranges::max_element(shared.kept_bodies), moving) << "nobody keeps all";
  EXPECT_TRUE(seen_shared(p, {-far, 0.185, far}, "", nullptr, p.job.scene.bodies.size()).kept_bodies.empty())
      << "of few bodies all processes keep all";
}

/// What changes is decided of the whole, which needs all bodies as they are now.
TEST(Halo, BodiesWithOwnersMeltMergeAndSplitAsTheWholeDoes) {
  for (const test::Prepared& p : {test::merging_and_splitting(SolidKind::rigid), test::eventful()}) {
    const Seen whole = seen_whole(p);
    const double border = p.job.scene.inflows.empty() ? 0.0036 : 0.22;
    for (const std::vector<double>& planes : {std::vector<double>{-far, border, far},
                                              {-far, border - 0.021, border - 0.004, border + 0.02, far}}) {
      SCOPED_TRACE(std::to_string(planes.size() - 1) + " slabs");
      expect_same(whole, seen_shared(p, planes, "", nullptr, all_have_owners));
    }
  }
}

/// A checkpoint has all bodies, and goes on in one process and over slabs, with owners and without.
TEST(Halo, ACheckpointHasBodiesAsTheirOwnersHaveThem) {
  const test::Prepared p = flying_blocks();
  const Seen whole = seen_whole(p);
  const Seen cut = seen_shared(p, {-far, 0.185, far}, "", nullptr, all_have_owners);
  for (const std::size_t owners_above : {all_have_owners, std::size_t{1000}}) {
    SCOPED_TRACE("owners above " + std::to_string(owners_above));
    expect_same(whole, seen_shared(p, {-far, 0.06, 0.13, 0.25, far}, "", &cut.kept, owners_above));
  }
  expect_same(whole, seen_whole(p, &cut.kept));
}

}  // namespace
}  // namespace tripoint
