// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "tables/expression.hpp"

namespace tripoint {
namespace {

double at(const char* text, const Vec3& r = {2.0, 3.0, 5.0}) { return Expression(text)(r); }

TEST(Expression, BindsAsInMathematics) {
  EXPECT_EQ(at("1 + 2 * 3"), 7.0);
  EXPECT_EQ(at("8 - 3 - 2"), 3.0);
  EXPECT_EQ(at("12 / 3 / 2"), 2.0);
  EXPECT_EQ(at("2 ^ 3 ^ 2"), 512.0);
  EXPECT_EQ(at("-2 ^ 2"), -4.0);
  EXPECT_EQ(at("2 ^ -1"), 0.5);
  EXPECT_EQ(at("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(at("--3"), 3.0);
}

TEST(Expression, KnowsPlaceConstantAndFunctions) {
  EXPECT_EQ(at("x + 10*y + 100*z"), 532.0);
  EXPECT_DOUBLE_EQ(at("300 + 10*cos(2*pi*x/4)"), 290.0);
  EXPECT_DOUBLE_EQ(at("sin(pi/2) + sqrt(16) + abs(-1) + exp(0)"), 7.0);
  EXPECT_EQ(at("min(x, y) - max(y, z)"), -3.0);
}

TEST(Expression, KnowsTheFunctionsOfTextbooks) {
  EXPECT_DOUBLE_EQ(at("erf(0.5) + erfc(0.5)"), 1.0);
  EXPECT_DOUBLE_EQ(at("log(exp(3)) + tan(pi/4)"), 4.0);
  EXPECT_DOUBLE_EQ(at("cosh(1)^2 - sinh(1)^2"), 1.0);
  EXPECT_DOUBLE_EQ(at("tanh(2)"), std::tanh(2.0));
}

TEST(Expression, SumsASeries) {
  EXPECT_EQ(at("sum(n, 1, 10, n)"), 55.0);
  EXPECT_EQ(at("1 + 2*sum(k, -1, 2, k*x)"), 9.0);
  EXPECT_NEAR(at("4*sum(n, 0, 9999, (-1)^n/(2*n + 1))"), std::numbers::pi, 1.1e-4);
  for (const char* text :
       {"sum(1, 1, 2, 3)", "sum(x, 1, 2, x)", "sum(n, 2, 1, n)", "sum(n, 1, 20000, n)", "sum(n, 1, 2)",
        "sum(n, 1, y, n)", "sum(n, 1, 2, sum(m, 1, 2, m))", "sum(n, 1, 2, n) + n"})
    EXPECT_THROW(Expression{text}, InputError) << text;
}

TEST(Expression, KnowsTimeWhereThereIsOne) {
  EXPECT_EQ(Expression("x + 10*t", Expression::Time::known)({2.0, 0.0, 0.0}, 3.0), 32.0);
  EXPECT_EQ(Expression("sum(n, 1, 2, t^n)", Expression::Time::known)({}, 3.0), 12.0);
  EXPECT_THROW(Expression("x + t"), InputError);
}

TEST(Expression, RefusesWithTheColumn) {
  const auto refused = [](const char* text) -> std::string {
    try {
      static_cast<void>(Expression(text));
      return "accepted";
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_NE(refused("1 + cso(x)").find("column 5"), std::string::npos);
  EXPECT_NE(refused("1 + cso(x)").find("did you mean `cos`"), std::string::npos);
  for (const char* text :
       {"", "1 +", "(1", "1)", "1 2", "x y", "min(1)", "sin x", "1 ** 2", "a", "1e999", "$", "nan", "inf"})
    EXPECT_NE(refused(text), "accepted") << text;
}

TEST(Expression, StopsAtABoundedDepthAndLength) {
  EXPECT_THROW(Expression(std::string(400, '(') + "1" + std::string(400, ')')), InputError);
  EXPECT_THROW(Expression(std::string(900, '-') + "1"), InputError);
  EXPECT_THROW(Expression("1" + std::string(2000, ' ')), InputError);
  std::string tower = "2";
  for (int i = 0; i < 200; ++i) tower += "^2";
  EXPECT_THROW(Expression{tower}, InputError);
}

}  // namespace
}  // namespace tripoint
