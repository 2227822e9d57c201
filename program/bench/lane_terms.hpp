// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/lanes.hpp"
#include "program/bench/lane_loops.hpp"

/// The pair formulas of the limit, bare: constant factors are left out, so that only what differs from pair
/// to pair is paid.
namespace tripoint::bench {

template <class V>
struct LanePair {
  V dx, dy, dz, r2;
  double h;
};

/// max(v, 0) without a branch.
template <class V>
[[nodiscard, gnu::always_inline]] inline V positive(V v) {
  const V zero{};
  return v > zero ? v : zero;
}

template <class V>
[[nodiscard, gnu::always_inline]] inline V distance(V r2) {
  return root(r2 + V{} + 1e-300);
}

/// (4): sum of (h2 - r2)^3.
struct SeedDensity {
  static constexpr std::array<std::size_t, 0> reads{};
  static constexpr std::size_t sums = 1;
  template <class V>
  [[gnu::always_inline]] static void pair(const LanePair<V>& g, const V*, const double*, V* sum) {
    const V q = positive(g.h * g.h - g.r2);
    sum[0] += q * q * q;
  }
};

/// (7), (8) and (21) with one square root and one division.
struct SeedRates {
  using C = LaneColumns;
  static constexpr std::array<std::size_t, 6> reads{C::u, C::v, C::w, C::pressure, C::volume, C::temperature};
  static constexpr std::size_t sums = 4;
  template <class V>
  [[gnu::always_inline]] static void pair(const LanePair<V>& g, const V* i, const double* j, V* sum) {
    const V r = distance(g.r2), q = positive(g.h - r), volume = j[4] * q;
    const V push = (i[3] + j[3]) * volume * q / r;
    sum[0] += push * g.dx + volume * (j[0] - i[0]);
    sum[1] += push * g.dy + volume * (j[1] - i[1]);
    sum[2] += push * g.dz + volume * (j[2] - i[2]);
    sum[3] += volume * (j[5] - i[5]);
  }
};

/// W'(r)/r of Wendland's kernel, without its factor.
template <class V>
[[nodiscard, gnu::always_inline]] inline V slope(V r, double h) {
  const V t = positive(1.0 - r * (1.0 / h));
  return t * t * t;
}

/// Number density (model 8.2) and second moment of heat (8.6).
struct CorrectedDensity {
  static constexpr std::array<std::size_t, 1> reads{LaneColumns::volume};
  static constexpr std::size_t sums = 7;
  template <class V>
  [[gnu::always_inline]] static void pair(const LanePair<V>& g, const V*, const double* j, V* sum) {
    const V q = distance(g.r2) * (1.0 / g.h), t = positive(1.0 - q), k = t * t * t, volume = j[0] * k;
    sum[0] += k * t * (1.0 + 4.0 * q);
    sum[1] += volume * g.dx * g.dx;
    sum[2] += volume * g.dy * g.dy;
    sum[3] += volume * g.dz * g.dz;
    sum[4] += volume * g.dy * g.dz;
    sum[5] += volume * g.dx * g.dz;
    sum[6] += volume * g.dx * g.dy;
  }
};

/// Conductance of a pair (model 8.6). @param m first of the six moments among the columns that are read
template <class V>
[[nodiscard, gnu::always_inline]] inline V conductance(const LanePair<V>& g, V k, V per_r2, V k_i, double k_j,
                                                       const V* i, const double* j) {
  const V along =
      (i[0] + j[0]) * g.dx * g.dx + (i[1] + j[1]) * g.dy * g.dy + (i[2] + j[2]) * g.dz * g.dz +
      2.0 * ((i[3] + j[3]) * g.dy * g.dz + (i[4] + j[4]) * g.dx * g.dz + (i[5] + j[5]) * g.dx * g.dy);
  return k * along * per_r2 * (k_i * k_j / (k_i + k_j));
}

/// Pressure and core (model 8.3), central viscosity (8.5), heat (8.6).
struct CorrectedRates {
  using C = LaneColumns;
  static constexpr std::array<std::size_t, 14> reads{
      C::u,          C::v,          C::w,           C::pressure,
      C::viscosity,  C::volume,     C::temperature, C::conductivity,
      C::moment,     C::moment + 1, C::moment + 2,  C::moment + 3,
      C::moment + 4, C::moment + 5};
  static constexpr std::size_t sums = 4;
  template <class V>
  [[gnu::always_inline]] static void pair(const LanePair<V>& g, const V* i, const double* j, V* sum) {
    const V r = distance(g.r2), k = slope(r, g.h), per_r2 = 1.0 / (g.r2 + V{} + 1e-300), volume = i[5] * j[5];
    const V core = positive(0.9 * (0.45 * g.h) - r) * (r * per_r2);
    const V approach = ((j[0] - i[0]) * g.dx + (j[1] - i[1]) * g.dy + (j[2] - i[2]) * g.dz) * per_r2;
    const V f = volume * (i[4] * j[4] / (i[4] + j[4])) * k * approach - (i[3] + j[3]) * k - core;
    sum[0] += f * g.dx;
    sum[1] += f * g.dy;
    sum[2] += f * g.dz;
    sum[3] += volume * conductance(g, k, per_r2, i[7], j[7], i + 8, j + 8) * (j[6] - i[6]);
  }
};

/// The second stage of heat's two (decision 5).
struct CorrectedHeat {
  using C = LaneColumns;
  static constexpr std::array<std::size_t, 9> reads{C::volume,     C::temperature, C::conductivity,
                                                    C::moment,     C::moment + 1,  C::moment + 2,
                                                    C::moment + 3, C::moment + 4,  C::moment + 5};
  static constexpr std::size_t sums = 1;
  template <class V>
  [[gnu::always_inline]] static void pair(const LanePair<V>& g, const V* i, const double* j, V* sum) {
    const V r = distance(g.r2), per_r2 = 1.0 / (g.r2 + V{} + 1e-300);
    sum[0] += i[0] * j[0] * conductance(g, slope(r, g.h), per_r2, i[2], j[2], i + 3, j + 3) * (j[1] - i[1]);
  }
};

}  // namespace tripoint::bench
