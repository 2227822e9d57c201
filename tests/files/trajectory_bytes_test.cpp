// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "core/errors.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

Trajectory some_trajectory() {
  Trajectory trajectory;
  double value = 0.5;
  const auto next = [&] { return value += 0.25; };
  const auto place = [&] { return Vec3{next(), next(), next()}; };
  for (int frame = 0; frame < 3; ++frame) {
    Snapshot s;
    s.time = next();
    s.step = 7 + frame;
    for (int i = 0; i < 4 + frame; ++i) {
      s.position.push_back(place());
      s.velocity.push_back(place());
      for (auto* column :
           {&s.temperature, &s.temperature_error, &s.density, &s.pressure, &s.liquid_fraction, &s.mass})
        column->push_back(next());
      for (auto* column : {&s.id, &s.phase, &s.body, &s.material})
        column->push_back(static_cast<int>(next()));
    }
    s.position[1].y = -std::numeric_limits<double>::quiet_NaN();
    s.bodies.push_back(
        {place(), place(), place(), {next(), next(), next(), next()}, next(), place(), place()});
    s.total_mass = next();
    s.momentum = place();
    s.angular_momentum = place();
    s.energy = {{"kinetic", next()}, {"", next()}};
    s.counts = {{"recoveries", next()}};
    s.heat_given = {{"a body", next()}};
    s.gauges = {{"gauge", next()}};
    trajectory.frames.push_back(s);
  }
  trajectory.frames[2].temperature.clear();
  return trajectory;
}

TEST(TrajectoryBytes, ComeBackWithTheirBits) {
  const std::string bytes = packed(some_trajectory());
  const Trajectory back = unpacked(bytes);
  EXPECT_EQ(packed(back), bytes);
  ASSERT_EQ(back.frames.size(), 3u);
  EXPECT_EQ(back.frames[1].step, 8);
  EXPECT_EQ(back.frames[1].position.size(), 5u);
  EXPECT_TRUE(back.frames[2].temperature.empty());
  EXPECT_EQ(back.frames[0].energy.at("kinetic"), some_trajectory().frames[0].energy.at("kinetic"));
  EXPECT_EQ(back.frames[0].bodies.at(0).mass, some_trajectory().frames[0].bodies.at(0).mass);
}

TEST(TrajectoryBytes, NothingThatIsCutIsWhole) {
  const std::string bytes = packed(some_trajectory());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(static_cast<void>(unpacked(bytes.substr(0, n))), InputError) << n;
  EXPECT_THROW(static_cast<void>(unpacked(bytes + "x")), InputError);
}

TEST(TrajectoryBytes, SizesAreNotTakenOnTrust) {
  const std::string bytes = packed(some_trajectory());
  EXPECT_THROW(static_cast<void>(unpacked(bytes, 2)), InputError);
  std::mt19937 draw(7);
  int refused = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string other = bytes;
    const std::size_t at = draw() % (bytes.size() - 8);
    const std::uint64_t size = k % 2 == 0 ? ~std::uint64_t{0} >> (draw() % 64) : draw();
    std::memcpy(other.data() + at, &size, sizeof size);
    try {
      const Trajectory t = unpacked(other, 10);
      EXPECT_LE(t.frames.size(), 10u);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(TrajectoryBytes, ColumnsOfUnequalLengthAreRefused) {
  Trajectory trajectory = some_trajectory();
  trajectory.frames[1].density.pop_back();
  EXPECT_THROW(static_cast<void>(unpacked(packed(trajectory))), InputError);
}

}  // namespace
}  // namespace tripoint
