// SPDX-License-Identifier: BSD-3-Clause
#include "core/field.hpp"

#include <gtest/gtest.h>

namespace tripoint {
namespace {

constexpr Field<double> warmth{"warmth", "K"};
constexpr Field<Vec3> place{"place", "m", Per::body};

TEST(Field, SaysItsNameUnitCarrierTypeAndSize) {
  const FieldInfo a = warmth, b = place;
  EXPECT_EQ(a.name, "warmth");
  EXPECT_EQ(a.unit, "K");
  EXPECT_EQ(a.per, Per::particle);
  EXPECT_EQ(a.type, FieldType::real);
  EXPECT_EQ(a.bytes, 8u);
  EXPECT_EQ(b.per, Per::body);
  EXPECT_EQ(b.type, FieldType::vector);
  EXPECT_EQ(b.bytes, 24u);
}

TEST(Field, OfTheSameNameButAnotherCarrierIsAnotherField) {
  constexpr Field<double> of_body{"warmth", "K", Per::body};
  EXPECT_FALSE(FieldInfo(warmth) == FieldInfo(of_body));
}

TEST(MissingField, SaysWhichFieldOfWhat) {
  const MissingField error("temperature", Per::particle);
  EXPECT_EQ(error.field(), "temperature");
  EXPECT_STREQ(error.what(), "no effect of this scene owns the field temperature (per particle)");
}

}  // namespace
}  // namespace tripoint
