// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "tables/units.hpp"

namespace tripoint {
namespace {

TEST(Units, AreTheDoubleNearestToTheDecimal) {
  EXPECT_EQ(parse_quantity("35 mm", "m"), 0.035);
  EXPECT_EQ(parse_quantity("7um", "m"), 7e-6);
  EXPECT_EQ(parse_quantity("0.1 ms", "s"), 1e-4);
  EXPECT_EQ(parse_quantity("+3 cm", "m"), 0.03);
}

TEST(Units, CombineByProductQuotientAndPower) {
  EXPECT_DOUBLE_EQ(parse_quantity("1.2 g/cm3", "kg/m3"), 1200.0);
  EXPECT_DOUBLE_EQ(parse_quantity("9.81 m s^-2", "m/s2"), 9.81);
  EXPECT_DOUBLE_EQ(parse_quantity("4.184 kJ/(kg K)", "J/kg/K"), 4184.0);
  EXPECT_DOUBLE_EQ(parse_quantity("1 mPa s", "Pa s"), 1e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("2 L/min", "m3/s"), 2e-3 / 60.0);
  EXPECT_DOUBLE_EQ(parse_quantity("210 GPa", "Pa"), 210e9);
}

TEST(Units, TurnAnglesIntoRadians) {
  EXPECT_DOUBLE_EQ(parse_quantity("180 deg", ""), std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("60 rpm", "rad/s"), 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_quantity("90 deg/s", "rad/s"), 0.5 * std::numbers::pi);
}

TEST(Units, CountCelsiusFromTheIcePoint) {
  EXPECT_DOUBLE_EQ(parse_quantity("20 degC", "K"), 293.15);
  // a difference is in K
  EXPECT_THROW(static_cast<void>(parse_quantity("20 degC/m", "K/m")), std::invalid_argument);
}

TEST(Units, RefuseAnotherDimensionSayingWhichIsExpected) {
  try {
    static_cast<void>(parse_quantity("3 kg", "s"));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("in kg, but a number in s is expected"), std::string::npos)
        << e.what();
  }
}

TEST(Units, RefuseWhatIsNoFiniteNumberWithAUnit) {
  for (const char* text : {"", "12", "m", "3 parsec", "nan m", "inf", "1e400 m", "3 m^", "3 (m", "3 m)",
                           "3 m//s", "3 m 4", "1e308 km", "--3 m", "3 ((m))"})
    EXPECT_THROW(static_cast<void>(parse_quantity(text, "m")), std::invalid_argument) << text;
}

TEST(Units, NameADimensionByItsBaseUnits) {
  EXPECT_EQ(to_string(parse_unit("W/m/K").dimension), "kg m/s3/K");
  EXPECT_EQ(to_string(parse_unit("").dimension), "1");
}

}  // namespace
}  // namespace tripoint
