// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "program/predict/shares.hpp"

namespace tripoint::predict {

Cuts cuts_of(const Cloud& cloud, int ranks) {
  if (cloud.position.empty()) throw InputError("there is no particle to share out");
  const ToShareOut what{cloud.position, cloud.idle, cloud.spacing, cloud.reach,
                        cloud.periodic, cloud.min,  cloud.max};
  return tripoint::cuts_of(what, rank_grid(ranks, what));
}

double messages_of(const Cuts& cuts, double reach) {
  double messages = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!cuts.cut(a)) continue;
    double thinnest = cuts.at[a].back() - cuts.at[a].front();
    for (std::size_t n = 1; n < cuts.at[a].size(); ++n)
      thinnest = std::min(thinnest, cuts.at[a][n] - cuts.at[a][n - 1]);
    const double hops = thinnest > 0.0 ? std::ceil(reach / thinnest) : 1.0;
    messages += 2.0 * std::clamp(hops, 1.0, static_cast<double>(cuts.grid[a]));
  }
  return messages;
}

}  // namespace tripoint::predict
