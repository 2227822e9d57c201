// SPDX-License-Identifier: BSD-3-Clause
#include "validation/mutation/smallest.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

// Of the start: smaller than any figure that a double could show beside 1
constexpr double least_share = 1e-15;

}  // namespace

SmallestVisible smallest_visible(double start, double greatest, const std::function<bool(double)>& seen) {
  SmallestVisible result;
  const auto is_seen = [&](double size) {
    ++result.runs;
    return seen(size);
  };
  std::optional<double> red, green;
  double stride = smallest_resolution;
  for (double size = std::min(start, greatest); !red || !green; stride *= stride) {
    if (is_seen(size))
      red = red ? std::min(*red, size) : size;
    else
      green = green ? std::max(*green, size) : size;
    if (red && !green && *red < least_share * start) {
      result.size = red;
      return result;
    }
    if (green && !red && *green >= greatest) {
      result.hidden = *green;
      return result;
    }
    size = red ? *red / stride : std::min(*green * stride, greatest);
  }
  // 1e-9: the first stride itself, rounded, is fine enough
  while (*red / *green > smallest_resolution * (1.0 + 1e-9)) {
    const double middle = std::sqrt(*red * *green);
    (is_seen(middle) ? red : green) = middle;
  }
  result.size = red;
  result.hidden = *green;
  result.found = true;
  return result;
}

Size against_stored(double now, double stored) {
  if (now > smallest_growth * stored) return Size::grew;
  return now * smallest_growth < stored ? Size::shrank : Size::held;
}

}  // namespace tripoint
