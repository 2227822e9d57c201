// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "sph/kernels.hpp"
#include "sph/moments.hpp"

namespace tripoint {
namespace {

constexpr double support = 2.6;

/// Calls visit(d, w) for the neighbours of the lattice, of spacing 1, at least `low` along each axis.
template <class Visit>
void each_neighbour(const Vec3& low, Visit visit) {
  const WendlandC2 kernel(support);
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        const Vec3 d{double(x), double(y), double(z)};
        const double r = norm(d);
        if (r == 0.0 || r >= support || d.x < low.x || d.y < low.y || d.z < low.z) continue;
        visit(d, -kernel.derivative_over_r(r));
      }
}

ConductionSums sums_of(const Vec3& low) {
  ConductionSums s;
  each_neighbour(low, [&](const Vec3& d, double w) {
    const Symmetric e = (1.0 / dot(d, d)) * square(d);
    s.with_xx = s.with_xx + (w * d.x * d.x) * e;
    const double yy = w * d.y * d.y, zz = w * d.z * d.z;
    const std::array<double, 9> parts{yy * e.yy, yy * e.zz, yy * e.yz, yy * e.xz, yy * e.xy,
                                      zz * e.zz, zz * e.yz, zz * e.xz, zz * e.xy};
    for (std::size_t k = 0; k < parts.size(); ++k) s.rest[k] += parts[k];
    s.lean = s.lean + 2.0 * w * d;
  });
  return s;
}

/// Q : B, what the weights conduct.
Symmetric conducted(const Vec3& low) {
  const Symmetric B = conduction_tensor(sums_of(low), 1.0);
  Symmetric sum;
  each_neighbour(low, [&](const Vec3& d, double w) {
    sum = sum + (w * contraction(B, square(d)) / dot(d, d)) * square(d);
  });
  return sum;
}

constexpr double everywhere = -3.0;
constexpr double faded = 0.08 * 0.08;  // of a direction that as many neighbours span as the mean one

TEST(ConductionTensor, MakesTheLatticeConductAsMatter) {
  const Symmetric all = conducted({everywhere, everywhere, everywhere});
  for (const double one : {all.xx, all.yy, all.zz}) EXPECT_NEAR(one, 1.0, 1e-14);
}

TEST(ConductionTensor, MakesAFaceConductAlongAsMatterAndLessAcross) {
  const Symmetric face = conducted({0.0, everywhere, everywhere});
  EXPECT_NEAR(face.yy, 1.0, faded);
  EXPECT_NEAR(face.zz, 1.0, faded);
  const double lean = sums_of({0.0, everywhere, everywhere}).lean.x;
  EXPECT_NEAR(face.xx, 1.0 - 0.62 * (lean * lean - 0.1), faded);
}

TEST(ConductionTensor, MakesALineConductAlongItself) {
  ConductionSums line;
  line.with_xx.xx = 0.3;
  EXPECT_NEAR(conduction_tensor(line, 1.0).xx * 0.3, 1.0, 1e-12);
}

TEST(ConductionTensor, OfNoNeighboursIsZero) { EXPECT_EQ(conduction_tensor({}, 1.0), Symmetric{}); }

}  // namespace
}  // namespace tripoint
