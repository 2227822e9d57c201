// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>
#include <vector>

#include "core/vec3.hpp"

namespace tripoint {

/// A formula of x, y, z [m] from a case file: numbers, + - * / ^, brackets, sin cos exp sqrt abs, min(a,b) max(a,b), pi.
/// ^ binds tighter than a sign before it and groups to the right: -2^2 = -4, 2^3^2 = 512.
class Expression {
 public:
  /// @throws InputError naming the column within the text (longer than 1000 bytes or deeper than 50 brackets is refused)
  explicit Expression(std::string_view text);
  /// The value at r; may be inf or NaN (division by 0), which the caller refuses.
  [[nodiscard]] double operator()(const Vec3& r) const;

  enum class Op : char { number, x, y, z, add, subtract, multiply, divide, power, negate, sine, cosine, exponential, root, absolute, least, greatest };
  struct Step {
    Op op;
    double value;  ///< number
  };

 private:
  std::vector<Step> steps_;  ///< reverse Polish
};

}  // namespace tripoint
