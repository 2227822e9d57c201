// SPDX-License-Identifier: BSD-3-Clause
// Loops over free particles against the same formulas for one particle after the other: the bits must be the
// same in every unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "core/machine.hpp"
#include "core/vec3.hpp"
#include "state/free_rows.hpp"

namespace tripoint {
namespace {

using Column = std::vector<double>;

/// Particles with forces of very different sizes, so that the order of sums shows; a row has no force at all.
struct Cloud {
  std::vector<Column> force;
  Column m;
  std::array<Column, 3> v, seen;
  FreeRows rows;

  Cloud(std::size_t count, std::size_t forces) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0), power(-8.0, 8.0);
    const auto some = [&](double scale) {
      Column c(count);
      for (double& value : c) value = scale * uniform(random) * std::exp2(power(random));
      return c;
    };
    for (std::size_t k = 0; k < 3 * forces; ++k) {
      force.push_back(some(1.0));
      force.back()[count / 2] = 0.0;
    }
    for (std::size_t a = 0; a < 3; ++a) v[a] = seen[a] = some(1.0);
    m = some(1.0);
    for (double& value : m) value = 0.5 + std::abs(value);
    rows.forces = forces;
    for (std::size_t k = 0; k < force.size(); ++k) rows.force[k] = force[k].data();
    rows.m = m.data();
    rows.g = {0.3, 0.0, -9.81};
  }
  [[nodiscard]] std::array<double*, 3> places(std::array<Column, 3>& of) {
    return {of[0].data(), of[1].data(), of[2].data()};
  }
  [[nodiscard]] Vec3 total(std::size_t i) const {
    Vec3 sum;
    for (std::size_t k = 0; k < rows.forces; ++k) sum += rows.force_on(i, k);
    return sum;
  }
  [[nodiscard]] Vec3 gravity() const { return {rows.g[0], rows.g[1], rows.g[2]}; }
  [[nodiscard]] Vec3 at(std::size_t i) const { return {v[0][i], v[1][i], v[2][i]}; }
};

std::vector<FreeLoops> loops_of_all_units(std::size_t forces) {
  std::vector<FreeLoops> list{free_loops_for<Any>(forces)};
  if (machine_has_avx2()) list.push_back(free_loops_for<Avx2>(forces));
  if (machine_has_avx512()) list.push_back(free_loops_for<Avx512>(forces));
  return list;
}

bool same_bits(const Column& a, const Column& b) {
  return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>,
                            std::bit_cast<std::uint64_t, double>);
}

constexpr double dt = 0.01;
// Whole chunks, a part of one, and rows that must stay as they are
constexpr std::size_t from = 3, to = 300, count = 310;

TEST(FreeRows, AreKickedWithTheBitsOfOneParticleAfterTheOther) {
  for (std::size_t forces = 0; forces <= most_forces; ++forces) {
    Cloud one(count, forces);
    std::array<double, most_forces + 1> work{};
    work.fill(1.0);
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 before = one.at(i), after = before + (dt / one.m[i]) * one.total(i) + dt * one.gravity();
      const Vec3 way = (0.5 * dt) * (before + after);
      for (std::size_t k = 0; k < forces; ++k) work[k] += dot(one.rows.force_on(i, k), way);
      work[gravity_work] += one.m[i] * dot(one.gravity(), way);
      for (std::size_t a = 0; a < 3; ++a) one.v[a][i] = after[a];
    }
    for (const FreeLoops& loops : loops_of_all_units(forces)) {
      Cloud cloud(count, forces);
      std::array<double, most_forces + 1> accumulated{};
      accumulated.fill(1.0);
      loops.kick(cloud.rows, cloud.places(cloud.v), dt, from, to, accumulated.data());
      EXPECT_EQ(accumulated, work) << forces << " forces";
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_TRUE(same_bits(cloud.v[a], one.v[a])) << forces << " forces, axis " << a;
    }
  }
}

TEST(FreeRows, ArePredictedWithThem) {
  for (const std::size_t forces : {0u, 1u, 4u}) {
    Cloud one(count, forces);
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 seen = one.at(i) + dt * (one.gravity() + one.total(i) / one.m[i]);
      for (std::size_t a = 0; a < 3; ++a) one.seen[a][i] = seen[a];
    }
    for (const FreeLoops& loops : loops_of_all_units(forces)) {
      Cloud cloud(count, forces);
      const std::array<const double*, 3> v{cloud.v[0].data(), cloud.v[1].data(), cloud.v[2].data()};
      loops.predict(cloud.rows, v, cloud.places(cloud.seen), dt, from, to);
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_TRUE(same_bits(cloud.seen[a], one.seen[a])) << forces << " forces, axis " << a;
    }
  }
}

TEST(FreeRows, HaveTheGreatestSpeedAndAccelerationWhereverItIs) {
  Cloud cloud(count, 2);
  const std::array<const double*, 3> v{cloud.v[0].data(), cloud.v[1].data(), cloud.v[2].data()};
  for (const FreeLoops& loops : loops_of_all_units(2)) {
    for (std::size_t past = from; past <= to; ++past) {
      double speed2 = 0.0, acceleration2 = 0.0;
      for (std::size_t i = from; i < past; ++i) {
        const Vec3 a = cloud.gravity() + cloud.total(i) / cloud.m[i];
        speed2 = std::max(speed2, dot(cloud.at(i), cloud.at(i)));
        acceleration2 = std::max(acceleration2, dot(a, a));
      }
      EXPECT_EQ(loops.greatest_speed2(v, from, past), speed2) << past;
      EXPECT_EQ(loops.greatest_acceleration2(cloud.rows, from, past), acceleration2) << past;
    }
  }
}

}  // namespace
}  // namespace tripoint
