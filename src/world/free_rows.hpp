// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "core/lanes.hpp"
#include "core/vec3.hpp"
#include "world/force.hpp"

/// Loops over particles that forces alone move, (18). They are compiled for each vector unit; the bits are those of one particle
/// after the other.
namespace tripoint {

/// What such loops read, as plain memory: code compiled for one vector unit shares nothing with the rest.
struct FreeRows {
  std::array<const double*, 3 * most_forces> force{};  ///< columns of each force, x, y, z after one another [N]
  std::size_t forces = 0;                              ///< how many there are
  const double* m = nullptr;                           ///< [kg]
  std::array<double, 3> g{};                           ///< [m/s2]

  /// One of the forces on a particle [N].
  [[nodiscard]] Vec3 force_on(std::size_t row, std::size_t k) const {
    return {force[3 * k][row], force[3 * k + 1][row], force[3 * k + 2][row]};
  }
};

/// Place of the work of gravity, behind those of the forces.
inline constexpr std::size_t gravity_work = most_forces;

/// The loops of a scene with that many forces, over rows from..to-1.
struct FreeLoops {
  /// v += dt (F/m + g). Adds to work[k] that of force k, dt F.(v- + v+)/2, and to work[gravity_work] that of gravity [J].
  void (*kick)(const FreeRows&, const std::array<double*, 3>& v, double dt, std::size_t from, std::size_t to, double* work);
  /// seen = v + ahead (g + F/m) [m/s]
  void (*predict)(const FreeRows&, const std::array<const double*, 3>& v, const std::array<double*, 3>& seen, double ahead,
                  std::size_t from, std::size_t to);
  /// Square of the greatest acceleration [m2/s4]
  double (*greatest_acceleration2)(const FreeRows&, std::size_t from, std::size_t to);
  /// Square of the greatest speed [m2/s2]
  double (*greatest_speed2)(const std::array<const double*, 3>& v, std::size_t from, std::size_t to);
};

namespace detail {

/// Component a of the sum of the forces on a particle [N].
template <class ForUnit, std::size_t n>
[[gnu::always_inline]] inline double total(const FreeRows& rows, std::size_t a, std::size_t i) {
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) sum += rows.force[3 * k + a][i];
  return sum;
}

/// The works are formed for some particles at once, and then added up in the order of rows.
template <class ForUnit, std::size_t n>
void kick(const FreeRows& rows, const std::array<double*, 3>& v, double dt, std::size_t from, std::size_t to, double* work) {
  constexpr std::size_t chunk = 128;
  std::array<double, n + 1> sum;
  for (std::size_t k = 0; k < n; ++k) sum[k] = work[k];
  sum[n] = work[gravity_work];
  double part[n + 1][chunk];
  const std::array<double, 3> g = rows.g;
  for (std::size_t start = from; start < to; start += chunk) {
    const std::size_t count = std::min(chunk, to - start);
#pragma omp simd
    for (std::size_t c = 0; c < count; ++c) {
      const std::size_t i = start + c;
      const double m = rows.m[i], per_mass = dt / m;
      double way[3];
      for (std::size_t a = 0; a < 3; ++a) {
        const double before = v[a][i], after = before + per_mass * total<ForUnit, n>(rows, a, i) + dt * g[a];
        way[a] = (0.5 * dt) * (before + after);
        v[a][i] = after;
      }
      for (std::size_t k = 0; k < n; ++k)
        part[k][c] = rows.force[3 * k][i] * way[0] + rows.force[3 * k + 1][i] * way[1] + rows.force[3 * k + 2][i] * way[2];
      part[n][c] = m * (g[0] * way[0] + g[1] * way[1] + g[2] * way[2]);
    }
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t k = 0; k <= n; ++k) sum[k] += part[k][c];
  }
  for (std::size_t k = 0; k < n; ++k) work[k] = sum[k];
  work[gravity_work] = sum[n];
}

template <class ForUnit, std::size_t n>
void predict(const FreeRows& rows, const std::array<const double*, 3>& v, const std::array<double*, 3>& seen, double ahead,
             std::size_t from, std::size_t to) {
#pragma omp simd
  for (std::size_t i = from; i < to; ++i) {
    const double m = rows.m[i];
    for (std::size_t a = 0; a < 3; ++a) seen[a][i] = v[a][i] + ahead * (rows.g[a] + total<ForUnit, n>(rows, a, i) / m);
  }
}

template <class ForUnit, std::size_t n>
double greatest_acceleration2(const FreeRows& rows, std::size_t from, std::size_t to) {
  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (std::size_t i = from; i < to; ++i) {
    const double m = rows.m[i];
    double a2[3];
    for (std::size_t a = 0; a < 3; ++a) {
      const double acceleration = rows.g[a] + total<ForUnit, n>(rows, a, i) / m;
      a2[a] = acceleration * acceleration;
    }
    most = std::max(most, a2[0] + a2[1] + a2[2]);
  }
  return most;
}

template <class ForUnit>
double greatest_speed2(const std::array<const double*, 3>& v, std::size_t from, std::size_t to) {
  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (std::size_t i = from; i < to; ++i) most = std::max(most, v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
  return most;
}

/// Rows that a thread takes at once.
inline constexpr std::size_t free_block = 1024;

}  // namespace detail

/// Calls visit(from, to) for blocks of the rows 0..rows-1, shared among threads.
template <class Visit>
void each_block(std::size_t rows, int threads, Visit visit) {
  const std::size_t blocks = (rows + detail::free_block - 1) / detail::free_block;
#pragma omp parallel for schedule(static) num_threads(threads) if (blocks > 1)
  for (std::size_t b = 0; b < blocks; ++b) visit(b * detail::free_block, std::min(rows, (b + 1) * detail::free_block));
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

struct World;

/// Those of the machine's widest vector unit. @param forces that the scene has, at most most_forces
[[nodiscard]] FreeLoops free_loops(std::size_t forces);
/// The scene's forces, masses and gravity. Valid until particles are sorted anew.
[[nodiscard]] FreeRows free_rows(const World&);

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
