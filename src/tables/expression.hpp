// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// A formula of x, y, z [m] from a case file. It has numbers, + - * / ^, brackets, pi, and the functions of
/// one and two arguments on the case-file page. It also has sum(n, 1, 40, f), the sum of f over whole n from
/// 1 to 40. The sign ^ binds tighter than a sign before it and groups to the right: -2^2 = -4, 2^3^2 = 512.
class Expression {
 public:
  /// Whether t [s] may stand in it: a start is of one time.
  enum class Time { none, known };
  /// @throws InputError naming the column within the text (longer than 1000 bytes or deeper than 50 brackets
  /// is refused)
  explicit Expression(std::string_view text, Time = Time::none);
  /// The value at r and t; may be inf or NaN (division by 0), which the caller refuses.
  [[nodiscard]] double operator()(const Vec3& r, double t = 0.0) const;

  enum class Op : char {
    number,
    x,
    y,
    z,
    t,
    index,
    sum,
    add,
    subtract,
    multiply,
    divide,
    power,
    least,
    greatest,
    negate,
    sine,
    cosine,
    tangent,
    exponential,
    logarithm,
    root,
    absolute,
    error,
    error_complement,
    hyperbolic_sine,
    hyperbolic_cosine,
    hyperbolic_tangent
  };
  struct Step {
    Op op;
    double value;  ///< number; of a sum its place in the list of sums
  };
  /// The steps over index = first .. last.
  struct Sum {
    long first, last;
    std::vector<Step> steps;
  };

 private:
  std::vector<Step> steps_;  ///< reverse Polish
  std::vector<Sum> sums_;
};

}  // namespace tripoint
