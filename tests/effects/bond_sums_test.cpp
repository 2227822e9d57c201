// SPDX-License-Identifier: BSD-3-Clause
#include "effects/elastic/bond_sums.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/machine.hpp"

namespace tripoint::elastic {
namespace {

/// Particle 0 with bonds to all others, in places and with deformations that have all bits.
struct Star {
  static constexpr std::uint32_t partners = 29;
  Bonds bonds;
  BondLists lists;
  std::vector<Place> places;
  std::vector<Deformed> deformed;

  Star() {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto any = [&] { return uniform(random); };
    const auto vector = [&] { return Vec3{any(), any(), any()}; };
    const auto bond = [&](double slope) {
      Bond b;
      b.x = vector();
      b.gradient = slope * b.x;
      b.weight = any();
      return b;
    };
    for (std::uint32_t j = 1; j <= partners; ++j) connect(bonds, 0, j, bond(any()), bond(any()));
    lists.follow(bonds);
    places.resize(partners + 1);
    deformed.resize(partners + 1);
    for (Place& p : places) p = {vector(), 1.0 + any()};
    for (Deformed& d : deformed) {
      d.measure_x = {any(), any(), any()};
      d.hourglass_energy = any();
      d.measure_y = {any(), any(), any(), any()};
      d.measure_z = {any(), any(), any(), any()};
      d.T_x = {any(), any(), any()};
      d.solid_hourglass = any();
      d.T_y = {any(), any(), any()};
      d.flat_hourglass = any();
      d.T_z = {any(), any(), any(), any()};
    }
  }
  [[nodiscard]] std::vector<Vec3> results(const BondSums& sum) const {
    const PeriodicWidths box{{0.5, 0.6, 0.7, 1.0}, {1.0, 1.2, 1.4, 0.0}};
    ReferenceSums r;
    ListSums s;
    PartnerForces f;
    sum.reference(lists.of(bonds, 0), lists.shapes(), places.data(), r);
    sum.list(lists.of(bonds, 0), lists.shapes(), places.data(), places[0], box, s);
    sum.partners(lists.of(bonds, 0), lists.shapes(), places.data(), deformed.data(), places[0], box, f);
    const Matrix3& m = r.moment;
    return {s.displacement.x, s.displacement.y,   s.displacement.z,   s.swept.x,          s.swept.y,
            s.swept.z,        {m.xx, m.xy, m.xz}, {m.yx, m.yy, m.yz}, {m.zx, m.zy, m.zz}, r.gradient,
            r.hourglass,      s.residual,         f.stress,           f.hourglass};
  }
};

TEST(BondSums, HaveTheSameBitsOnEveryVectorUnit) {
  if (!machine_has_avx2()) GTEST_SKIP() << "this machine has no AVX2";
  const Star star;
  for (const bool periodic : {false, true})
    for (const bool hourglass : {false, true})
      for (const bool bends : {false, true})
        EXPECT_EQ(star.results(bond_sums_for<Any>({periodic, hourglass, bends})),
                  star.results(bond_sums_for<Avx2>({periodic, hourglass, bends})));
}

TEST(BondSums, SeeATwinAsItsOwnListHasIt) {
  const Star star;
  const BondLists::List list = star.lists.of(star.bonds, 0);
  for (std::size_t n = 0; n < list.count; ++n) {
    const Bond& bond = star.bonds.of(0)[n];
    EXPECT_EQ(list.other[n], bond.other);
    EXPECT_EQ(star.lists.shapes()[list.shape[n]].x, bond.x);
    EXPECT_EQ(star.lists.shapes()[list.seen[n]].x, star.bonds.of(bond.other)[bond.twin].x);
  }
}

TEST(BondSums, FollowBondsThatEnd) {
  Star star;
  disconnect(star.bonds, 0, [](const Bond& b) { return b.other % 3 == 0; });
  star.lists.follow(star.bonds);
  const BondLists::List list = star.lists.of(star.bonds, 0);
  ASSERT_EQ(list.count, 20u);
  for (std::size_t n = 0; n < list.count; ++n) {
    const Bond& bond = star.bonds.of(0)[n];
    EXPECT_EQ(list.other[n], bond.other);
    EXPECT_EQ(star.lists.shapes()[list.shape[n]].x, bond.x);
    EXPECT_EQ(star.lists.shapes()[list.seen[n]].x, star.bonds.of(bond.other)[bond.twin].x);
  }
}

}  // namespace
}  // namespace tripoint::elastic
