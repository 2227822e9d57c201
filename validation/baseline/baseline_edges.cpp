// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "validation/baseline/baseline.hpp"

namespace tripoint {
namespace {

/// Edges of the values that a gate lets pass. A limit bounds the size, which is both sides.
struct Edges {
  std::optional<double> lowest, highest;
  double precision = 1e-9;  ///< share to which they are known
};

void narrow(Edges& e, std::optional<double> lowest, std::optional<double> highest) {
  if (lowest && (!e.lowest || *lowest > *e.lowest)) e.lowest = lowest;
  if (highest && (!e.highest || *highest < *e.highest)) e.highest = highest;
}

/// Edges for a baseline that keeps none: from its words, which have six digits.
Edges edges_of_words(const std::string& allows) {
  Edges e;
  e.precision = 1e-5;
  double a = 0.0, b = 0.0;
  if (const auto at = allows.find("limit ");
      at != std::string::npos && std::sscanf(allows.c_str() + at, "limit %lf", &a) == 1)
    narrow(e, -a, a);
  if (const auto at = allows.find("at least ");
      at != std::string::npos && std::sscanf(allows.c_str() + at, "at least %lf", &a) == 1)
    narrow(e, a, {});
  if (const auto at = allows.find("band ");
      at != std::string::npos && std::sscanf(allows.c_str() + at, "band %lf to %lf", &a, &b) == 2)
    narrow(e, a, b);
  return e;
}

Edges accepted_edges(const AcceptedGate& g) {
  Edges e;
  if (!g.limit && !g.at_least && !g.band) return edges_of_words(g.allows);
  if (g.limit) narrow(e, -*g.limit, *g.limit);
  if (g.at_least) narrow(e, *g.at_least, {});
  if (g.band) narrow(e, (*g.band)[0], (*g.band)[1]);
  return e;
}

std::string edge(const char* name, const std::optional<double>& now, const std::optional<double>& old,
                 double sign, double precision) {
  if (!old) return {};
  if (!now) return fmt::format("its {} edge, {:g}, is gone", name, *old);
  if (sign * (*now - *old) <= precision * std::abs(*old)) return {};
  return fmt::format("its {} edge has moved from {:g} to {:g}", name, *old, *now);
}

}  // namespace

bool is_nearer_truth(const AcceptedGate& now, const AcceptedGate& old) {
  const auto a = accepted_edges(now), b = accepted_edges(old);
  if (!a.lowest || !a.highest || !b.lowest || !b.highest || !old.band) return false;
  if (*a.highest - *a.lowest > *b.highest - *b.lowest) return false;
  const double most = std::max(std::abs(*a.lowest), std::abs(*a.highest));
  const double far = std::max(std::abs(*b.lowest), std::abs(*b.highest)),
               near = std::min(std::abs(*b.lowest), std::abs(*b.highest));
  const bool same_side = (*b.lowest > 0.0 && *a.lowest >= 0.0) || (*b.highest < 0.0 && *a.highest <= 0.0);
  return *b.lowest * *b.highest > 0.0 && most <= (same_side ? far : near);
}

std::string looser_edge(const AcceptedGate& now, const AcceptedGate& old) {
  const auto a = accepted_edges(now), b = accepted_edges(old);
  const double precision = std::max(a.precision, b.precision);
  if (const auto text = edge("upper", a.highest, b.highest, 1.0, precision); !text.empty()) return text;
  if (const auto text = edge("lower", a.lowest, b.lowest, -1.0, precision); !text.empty()) return text;
  const bool drifts = old.drift && (!now.drift || *now.drift > *old.drift * (1.0 + precision));
  if (drifts)
    return fmt::format("the drift that it allows was {:g} and is {}", *old.drift,
                       now.drift ? fmt::format("{:g}", *now.drift) : "not bounded");
  return {};
}

}  // namespace tripoint
