// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "core/lanes.hpp"
#include "core/vec3.hpp"
#include "state/force.hpp"

/// Loops over particles that forces alone move, (18). They are compiled for each vector unit; the bits are
/// those of one particle after the other.
namespace tripoint {

/// What such loops read, as plain memory: code compiled for one vector unit shares nothing with the rest.
struct FreeRows {
  /// Columns of each force, x, y, z after one another [N]
  std::array<const double*, 3 * most_forces> force{};
  std::size_t forces = 0;     ///< how many there are
  const double* m = nullptr;  ///< [kg]
  std::array<double, 3> g{};  ///< [m/s2]

  /// One of the forces on a particle [N].
  [[nodiscard]] Vec3 force_on(std::size_t row, std::size_t k) const {
    return {force[3 * k][row], force[3 * k + 1][row], force[3 * k + 2][row]};
  }
};

/// Place of the work of gravity, behind those of the forces.
inline constexpr std::size_t gravity_work = most_forces;

/// The loops of a scene with that many forces, over rows from..to-1.
struct FreeLoops {
  /// v += dt (F/m + g). Adds to work[k] that of force k, dt F.(v- + v+)/2, and to work[gravity_work] that of
  /// gravity [J].
  void (*kick)(const FreeRows&, const std::array<double*, 3>& v, double dt, std::size_t from, std::size_t to,
               double* work);
  /// seen = v + ahead (g + F/m) [m/s]
  void (*predict)(const FreeRows&, const std::array<const double*, 3>& v, const std::array<double*, 3>& seen,
                  double ahead, std::size_t from, std::size_t to);
  /// Square of the greatest acceleration [m2/s4]
  double (*greatest_acceleration2)(const FreeRows&, std::size_t from, std::size_t to);
  /// Square of the greatest speed [m2/s2]
  double (*greatest_speed2)(const std::array<const double*, 3>& v, std::size_t from, std::size_t to);
};

namespace detail {

template <int L>
[[gnu::always_inline]] inline void store_lanes(double* to, typename Lanes<L>::Real v) {
  std::memcpy(to, &v, sizeof v);
}

/// Calls visit<L>(i) for as many rows side by side as there are, and visit<1>(i) for those that are left.
template <int L, class ForUnit, class Visit>
[[gnu::always_inline]] inline void side_by_side(std::size_t from, std::size_t to, Visit visit) {
  std::size_t i = from;
  for (; i + L <= to; i += L) visit.template operator()<L>(i);
  for (; i < to; ++i) visit.template operator()<1>(i);
}

/// Component a of the sum of the forces on particles [N].
template <int L, class ForUnit, std::size_t n>
[[gnu::always_inline]] inline typename Lanes<L>::Real total(const FreeRows& rows, std::size_t a,
                                                            std::size_t i) {
  typename Lanes<L>::Real sum{};
  for (std::size_t k = 0; k < n; ++k) sum += load_lanes<L>(rows.force[3 * k + a] + i);
  return sum;
}

/// The works are formed for some particles side by side, and then added up in the order of rows.
template <int L, class ForUnit, std::size_t n>
[[gnu::flatten]] void kick(const FreeRows& rows, const std::array<double*, 3>& v, double dt, std::size_t from,
                           std::size_t to, double* work) {
  constexpr std::size_t chunk = 128;
  std::array<double, n + 1> sum;
  for (std::size_t k = 0; k < n; ++k) sum[k] = work[k];
  sum[n] = work[gravity_work];
  double part[n + 1][chunk];
  const std::array<double, 3> g = rows.g;
  for (std::size_t start = from; start < to; start += chunk) {
    const std::size_t past = std::min(to, start + chunk);
    side_by_side<L, ForUnit>(start, past, [&]<int W>(std::size_t i) {
      using V = typename Lanes<W>::Real;
      const V m = load_lanes<W>(rows.m + i), per_mass = dt / m;
      V way[3];
      for (std::size_t a = 0; a < 3; ++a) {
        const V before = load_lanes<W>(v[a] + i),
                after = before + per_mass * total<W, ForUnit, n>(rows, a, i) + dt * g[a];
        way[a] = (0.5 * dt) * (before + after);
        store_lanes<W>(v[a] + i, after);
      }
      for (std::size_t k = n; k-- > 0;) {
        const auto force = [&](std::size_t a) { return load_lanes<W>(rows.force[3 * k + a] + i); };
        store_lanes<W>(part[k] + (i - start), force(0) * way[0] + force(1) * way[1] + force(2) * way[2]);
      }
      store_lanes<W>(part[n] + (i - start), m * (g[0] * way[0] + g[1] * way[1] + g[2] * way[2]));
    });
    for (std::size_t c = 0; c < past - start; ++c)
      for (std::size_t k = 0; k <= n; ++k) sum[k] += part[k][c];
  }
  for (std::size_t k = 0; k < n; ++k) work[k] = sum[k];
  work[gravity_work] = sum[n];
}

template <int L, class ForUnit, std::size_t n>
[[gnu::flatten]] void predict(const FreeRows& rows, const std::array<const double*, 3>& v,
                              const std::array<double*, 3>& seen, double ahead, std::size_t from,
                              std::size_t to) {
  side_by_side<L, ForUnit>(from, to, [&]<int W>(std::size_t i) {
    const auto m = load_lanes<W>(rows.m + i);
    for (std::size_t a = 0; a < 3; ++a)
      store_lanes<W>(seen[a] + i,
                     load_lanes<W>(v[a] + i) + ahead * (rows.g[a] + total<W, ForUnit, n>(rows, a, i) / m));
  });
}

/// Greatest of square<W>(i), and at least 0.
template <int L, class ForUnit, class Square>
[[gnu::always_inline]] inline double greatest_of(std::size_t from, std::size_t to, Square square) {
  typename Lanes<L>::Real most{};
  double greatest = 0.0;
  side_by_side<L, ForUnit>(from, to, [&]<int W>(std::size_t i) {
    const auto next = square.template operator()<W>(i);
    if constexpr (W == L)
      most = next > most ? next : most;
    else
      greatest = next > greatest ? next : greatest;
  });
  double lane[L];
  std::memcpy(lane, &most, sizeof lane);
  for (const double of_lane : lane) greatest = of_lane > greatest ? of_lane : greatest;
  return greatest;
}

template <int L, class ForUnit, std::size_t n>
[[gnu::flatten]] double greatest_acceleration2(const FreeRows& rows, std::size_t from, std::size_t to) {
  return greatest_of<L, ForUnit>(from, to, [&]<int W>(std::size_t i) {
    using V = typename Lanes<W>::Real;
    const V m = load_lanes<W>(rows.m + i);
    V a2[3];
    for (std::size_t a = 0; a < 3; ++a) {
      const V acceleration = rows.g[a] + total<W, ForUnit, n>(rows, a, i) / m;
      a2[a] = acceleration * acceleration;
    }
    return a2[0] + a2[1] + a2[2];
  });
}

template <int L, class ForUnit>
[[gnu::flatten]] double greatest_speed2(const std::array<const double*, 3>& v, std::size_t from,
                                        std::size_t to) {
  return greatest_of<L, ForUnit>(from, to, [&]<int W>(std::size_t i) {
    const auto x = load_lanes<W>(v[0] + i), y = load_lanes<W>(v[1] + i), z = load_lanes<W>(v[2] + i);
    return x * x + y * y + z * z;
  });
}

/// Rows that a thread takes at once.
inline constexpr std::size_t free_block = 1024;

}  // namespace detail

/// Calls visit(from, to) for blocks of the rows 0..rows-1, shared among threads.
template <class Visit>
void each_block(std::size_t rows, int threads, Visit visit) {
  const std::size_t blocks = (rows + detail::free_block - 1) / detail::free_block;
#pragma omp parallel for schedule(static) num_threads(threads) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b)
    visit(b * detail::free_block, std::min(rows, (b + 1) * detail::free_block));
}
/// Greatest of find(from, to), which is not negative, over the same blocks.
template <class Find>
[[nodiscard]] double greatest_of_blocks(std::size_t rows, int threads, Find find) {
  const std::size_t blocks = (rows + detail::free_block - 1) / detail::free_block;
  double most = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) if (blocks > 1) reduction(max : most)
  for (std::size_t b = 0; b < blocks; ++b)
    most = std::max(most, find(b * detail::free_block, std::min(rows, (b + 1) * detail::free_block)));
  return most;
}

struct State;

/// Those of the machine's widest vector unit. @param forces that the scene has, at most most_forces
[[nodiscard]] FreeLoops free_loops(std::size_t forces);
/// The scene's forces, masses and gravity. Valid until particles are sorted anew.
[[nodiscard]] FreeRows free_rows(const State&);

/// Those of a vector unit. @param forces that the scene has, at most most_forces
template <class ForUnit>
[[nodiscard]] FreeLoops free_loops_for(std::size_t forces);
template <>
FreeLoops free_loops_for<Any>(std::size_t forces);
template <>
FreeLoops free_loops_for<Avx2>(std::size_t forces);
template <>
FreeLoops free_loops_for<Avx512>(std::size_t forces);

}  // namespace tripoint
