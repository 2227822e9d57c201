// SPDX-License-Identifier: BSD-3-Clause
// What each rank would hold: counted one by one and by volume, against numbers worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "program/predict/shares.hpp"

namespace tripoint::predict {
namespace {

/// A lattice of n particles along each direction, a cell of 1 each, in its middle.
Cloud lattice(int nx, int ny, int nz, bool periodic) {
  Cloud c;
  c.spacing = 1.0;
  c.reach = 2.5;
  c.pair_reach = 1.1;
  c.max = {static_cast<double>(nx), static_cast<double>(ny), static_cast<double>(nz)};
  if (periodic) c.periodic = {true, true, true};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) c.position.push_back({x + 0.5, y + 0.5, z + 0.5});
  return c;
}

double total(const Shares& s, double Share::*what) {
  return std::accumulate(s.ranks.begin(), s.ranks.end(), 0.0,
                         [&](double sum, const Share& r) { return sum + r.*what; });
}

TEST(Shares, OneRankHoldsAllAndNoCopies) {
  const Shares s = share_out(lattice(6, 5, 4, true), 1);
  ASSERT_EQ(s.ranks.size(), 1U);
  EXPECT_EQ(s.ranks[0].own, 120.0);
  EXPECT_EQ(s.ranks[0].copies, 0.0);
  EXPECT_EQ(s.ranks[0].pairs, 720.0);  // six neighbours at a distance of 1, also across the boundaries
  EXPECT_EQ(s.messages, 0.0);
}

TEST(Shares, AFreeBlockHasFewerPairsAtItsFaces) {
  const Shares s = share_out(lattice(6, 5, 4, false), 1);
  EXPECT_EQ(s.ranks[0].pairs, 2.0 * (5 * 5 * 4 + 6 * 4 * 4 + 6 * 5 * 3));  // edges of the lattice, both ways
}

/// A slab of a periodic bar sees two layers on each side within 2.5, the cut lying half a cell from the next
/// layer: 0.5, 1.5 and 2.5.
TEST(Shares, ASlabHasTheLayersWithinReachOnBothSides) {
  Cloud bar = lattice(20, 4, 4, true);
  bar.reach = 2.4;  // 0.5 and 1.5 beyond the cut
  const Shares s = share_out(bar, 2);
  EXPECT_EQ(s.grid, (std::array<int, 3>{2, 1, 1}));
  for (const Share& r : s.ranks) {
    EXPECT_EQ(r.own, 160.0);
    EXPECT_EQ(r.copies, 2 * 2 * 16.0);
    EXPECT_EQ(r.pairs, 10 * 16 * 6.0);  // copies' sums are their owners'
    EXPECT_EQ(r.worked, r.pairs);
  }
  EXPECT_EQ(s.messages, 2.0);
}

TEST(Shares, AFreeBarHasCopiesOnOneSideOfEachRank) {
  Cloud bar = lattice(20, 4, 4, false);
  bar.reach = 2.4;
  const Shares s = share_out(bar, 2);
  for (const Share& r : s.ranks) {
    EXPECT_EQ(r.own, 160.0);
    EXPECT_EQ(r.copies, 32.0);
  }
}

/// (n^(1/3) + 2 r)^3 - n, with layers for r: a cube in the midst of others.
TEST(Shares, ACubeAmongCubesHasTheShellWithinReach) {
  Cloud c = lattice(18, 18, 18, true);
  c.reach = 2.4;
  const Shares s = share_out(c, 27);
  EXPECT_EQ(s.grid, (std::array<int, 3>{3, 3, 3}));
  EXPECT_EQ(s.messages, 6.0);
  for (const Share& r : s.ranks) {
    EXPECT_EQ(r.own, 216.0);
    EXPECT_EQ(r.copies, std::pow(6.0 + 2 * 2, 3) - 216.0);
  }
}

/// By volume the formula holds to round-off, for a number of particles that nobody has sampled.
TEST(Shares, ByVolumeTheShellIsThatOfTheFormula) {
  const Cloud c = lattice(18, 18, 18, true);
  for (const double particles : {5832.0, 5.832e6, 5.832e9}) {
    const Shares s = share_volume(c, 27, particles);
    const double n = particles / 27.0, expected = std::pow(std::cbrt(n) + 2.0 * c.reach, 3) - n;
    for (const Share& r : s.ranks) {
      EXPECT_NEAR(r.own / n, 1.0, 1e-9);
      // round-off of shells that are a thousandth of the whole
      EXPECT_NEAR(r.copies / expected, 1.0, 1e-6) << particles;
    }
  }
}

TEST(Shares, ByVolumeNothingIsLostHoweverManyRanks) {
  const Cloud c = lattice(12, 10, 8, false);
  for (const int ranks : {1, 2, 6, 64, 500})
    EXPECT_NEAR(total(share_volume(c, ranks, 1e7), &Share::own) / 1e7, 1.0, 1e-9) << ranks;
}

/// Of a hundred million particles a part is many layers thick, whatever the number of layers that were
/// sampled.
TEST(Shares, ByVolumeCutsAreNotHeldBetweenSampledLayers) {
  for (const int layers : {10, 40, 100}) {
    const Shares s = share_volume(lattice(layers, 6, 6, false), 32, 1e8);
    for (const Share& r : s.ranks) EXPECT_NEAR(r.own / (1e8 / 32.0), 1.0, 0.04) << layers;
  }
}

/// A reach of whole layers, so that both ways see the same copies.
TEST(Shares, PairsByVolumeAreThoseThatAreCounted) {
  Cloud c = lattice(24, 24, 24, true);
  c.reach = 3.0;
  c.pair_reach = 3.0;
  const Shares counted = share_out(c, 8), scaled = share_volume(c, 8, 24.0 * 24.0 * 24.0);
  EXPECT_NEAR(scaled.ranks[0].pairs / counted.ranks[0].pairs, 1.0, 1e-6);
  EXPECT_NEAR(scaled.ranks[0].worked / counted.ranks[0].worked, 1.0, 1e-6);
  EXPECT_NEAR(share_volume(c, 1, 1e9).ranks[0].pairs / share_out(c, 1).ranks[0].pairs,
              1e9 / (24.0 * 24.0 * 24.0), 1e-3);
}

/// A column in one half of a wide tank: equal parts would give one rank nearly all.
TEST(Shares, CutsMoveToWhereTheParticlesAre) {
  Cloud c = lattice(16, 8, 8, false);
  for (int x = 16; x < 64; ++x) c.position.push_back({x + 0.5, 0.5, 0.5});
  const Shares s = share_out(c, 4);
  const double mean = total(s, &Share::own) / 4.0;
  EXPECT_EQ(total(s, &Share::own), static_cast<double>(c.position.size()));
  // Two layers of 64 of 268 cannot be cut finer
  for (const Share& r : s.ranks) EXPECT_NEAR(r.own / mean, 1.0, 0.2);
}

/// Two layers of fixed particles under ten that move: pairs among the fixed ones have no work, and a rank has
/// more of these.
TEST(Shares, WhatIsIdleCostsLittle) {
  Cloud c = lattice(4, 4, 12, false);
  for (const Vec3& r : c.position) c.idle.push_back(r.z < 2.0);
  const Share whole = share_out(c, 1).ranks[0];
  // Edges within the two layers, and between them
  EXPECT_EQ(whole.pairs - whole.worked, 2.0 * (2 * 24 + 16));
  EXPECT_EQ(share_volume(c, 1, 192.0).ranks[0].worked, whole.worked);
  const Shares two = share_out(c, 2);
  EXPECT_EQ(two.grid, (std::array<int, 3>{1, 1, 2}));
  EXPECT_EQ(two.ranks[0].own, 7 * 16.0);  // five layers that move and the two that do not
}

TEST(Shares, AReachBeyondTheNextRankTakesMoreMessages) {
  Cloud c = lattice(16, 2, 2, true);
  c.reach = 3.0;
  EXPECT_EQ(share_out(c, 8).messages, 4.0);  // parts of 2, a reach of 3: two hops each way
}

}  // namespace
}  // namespace tripoint::predict
