// SPDX-License-Identifier: BSD-3-Clause
#include "sph/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tripoint::solid {
namespace {

constexpr Symmetric all{1.0, 1.0, 1.0, 0.0, 0.0, 0.0};

double size(const Symmetric& a) { return std::sqrt(contraction(a, a)); }
double size(const Matrix3& a) {
  const Matrix3 b = transposed(a) * a;
  return std::sqrt(b.xx + b.yy + b.zz);
}
Matrix3 rotation(const Vec3& angle) {
  const Quaternion q = from_rotation_vector(angle);
  const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}
/// Turns a symmetric matrix with the axes.
Symmetric turned(const Matrix3& R, const Symmetric& a) { return symmetric_part(R * full(a) * transposed(R)); }

const Vec3 angle{0.4, -1.1, 0.7};

TEST(ShapeInverse, CutsWhatIsBelowAFifthOfTheLargestAndInvertsTheRest) {
  const Matrix3 R = rotation(angle);
  const ShapeInverse solid = shape_inverse(turned(R, {1.0, 0.6, 0.21, 0, 0, 0})),
                     sheet = shape_inverse(turned(R, {1.0, 0.6, 0.19, 0, 0, 0}));
  EXPECT_EQ(solid.rank, 3);
  EXPECT_LT(size(solid.inverse - turned(R, {1.0, 1.0 / 0.6, 1.0 / 0.21, 0, 0, 0})), 1e-14);
  EXPECT_EQ(sheet.rank, 2);
  EXPECT_LT(size(sheet.inverse - turned(R, {1.0, 1.0 / 0.6, 0.0, 0, 0, 0})), 1e-14);
  EXPECT_EQ(shape_inverse(turned(R, {1.0, 0.1, 0.0, 0, 0, 0})).rank, 1);
  EXPECT_EQ(shape_inverse({}).rank, 0);
}

TEST(RangeProjector, KeepsTheDirectionsOfTheInverseAndNoOther) {
  const Matrix3 R = rotation(angle);
  EXPECT_EQ(range_projector(turned(R, {1.0, 2.0, 3.0, 0, 0, 0}), 3), all);
  EXPECT_LT(size(range_projector(turned(R, {1.0, 2.0, 0.0, 0, 0, 0}), 2) - turned(R, {1, 1, 0, 0, 0, 0})),
            1e-14);
  EXPECT_LT(size(range_projector(turned(R, {0.0, 0.0, 5.0, 0, 0, 0}), 1) - turned(R, {0, 0, 1, 0, 0, 0})),
            1e-14);
  EXPECT_EQ(range_projector({}, 0), Symmetric{});
}

TEST(Strain, OfGreenIsHalfThePrintedOneAndNothingUnderRotation) {
  const Matrix3 R = rotation(angle), F = R * Matrix3{1.1, 0.02, 0.0, 0.0, 0.95, 0.01, 0.03, 0.0, 1.0};
  EXPECT_LT(size(green_strain(R)), 1e-15);
  EXPECT_LT(size(strain_paper(F) - 2.0 * green_strain(F)), 1e-15);
  EXPECT_NEAR(green_strain(Matrix3{1.2, 0, 0, 0, 1, 0, 0, 0, 1}).xx, 0.22, 1e-15);
}

TEST(Stress, OfAFreeBarIsItsYoungsModulusInSolidsSheetsAndChains) {
  const double E = 3.0, nu = 0.3, e = 0.01;
  const ElasticConstants c = elastic_constants(E, nu);
  EXPECT_NEAR(stress({e, -nu * e, -nu * e, 0, 0, 0}, all, 3, c).xx, E * e, 1e-15);
  EXPECT_NEAR(stress({e, -nu * e, -nu * e, 0, 0, 0}, all, 3, c).yy, 0.0, 1e-15);
  const Symmetric plane{1, 1, 0, 0, 0, 0}, line{1, 0, 0, 0, 0, 0};
  // Contracts in its plane, nothing across
  EXPECT_NEAR(stress({e, -nu * e, 0, 0, 0, 0}, plane, 2, c).xx, E * e, 1e-15);
  EXPECT_NEAR(stress({e, -nu * e, 0, 0, 0, 0}, plane, 2, c).yy, 0.0, 1e-15);
  EXPECT_NEAR(stress({e, 0, 0, 0, 0, 0}, line, 1, c).xx, E * e, 1e-15);
  EXPECT_NEAR(stress({0, 0, 0, 0, 0, e}, all, 3, c).xy, E / (1.0 + nu) * e, 1e-15);  // 2 mu e
}

TEST(Rotation, IsFoundAgainBeneathAStretch) {
  const Matrix3 R = rotation(angle), stretch{1.2, 0.1, 0.0, 0.1, 0.9, 0.05, 0.0, 0.05, 1.1};
  EXPECT_LT(size(rotation_of(R * stretch, all, 3) - R), 1e-14);
  // F of a sheet keeps the normal: only F P tells
  const Matrix3 in_plane{1.2, 0.1, 0.0, 0.1, 0.9, 0.0, 0.0, 0.0, 1.0};
  const Symmetric plane{1, 1, 0, 0, 0, 0};
  const Matrix3 sheet = identity3 + (R * in_plane - identity3) * plane;
  EXPECT_LT(size(rotation_of(sheet, plane, 2) - R), 1e-14);
  EXPECT_EQ(rotation_of(R, {}, 0), identity3);
}

TEST(Rotation, OfAChainIsTheLeastOneOfItsLine) {
  const Symmetric line{1, 0, 0, 0, 0, 0};
  const Matrix3 F = identity3 + (rotation({0.0, 0.0, 0.8}) - identity3) * line;
  EXPECT_LT(size(rotation_of(F, line, 1) - rotation({0.0, 0.0, 0.8})), 1e-14);
}

TEST(Rotation, AsQuaternionTurnsAlike) {
  const Vec3 v{0.3, -0.7, 0.2};
  EXPECT_LT(norm(rotate(quaternion_of(rotation(angle)), v) - rotation(angle) * v), 1e-15);
}

TEST(Hourglass, ResidualIsNothingWhereAllMoveByF) {
  const Matrix3 F = rotation(angle) * Matrix3{1.1, 0.02, 0.0, 0.0, 0.95, 0.01, 0.03, 0.0, 1.0};
  const Vec3 x{0.3, -0.2, 0.5};
  EXPECT_LT(norm(hourglass_residual(F, x, F * x)), 1e-15);
  EXPECT_NEAR(hourglass_residual_flat(green_strain(F), x, F * x), 0.0, 1e-15);
  EXPECT_NEAR(hourglass_residual_flat({}, x, 1.1 * x), 0.5 * (1.21 - 1.0), 1e-15);
}

}  // namespace
}  // namespace tripoint::solid
