// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/errors.hpp"
#include "files/gauge_error.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace {

struct Io : ::testing::Test {
  Io() : folder(std::filesystem::temp_directory_path() / ("tripoint io " + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~Io() override { std::filesystem::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::filesystem::path folder;
};

Snapshot frame_at(double time, int particles, int bodies) {
  Snapshot s;
  s.time = time;
  s.step = std::lround(10 * time);
  for (int i = 0; i < particles; ++i) {
    s.position.push_back({time + i, 0.1 * i, -1.0 / (i + 3)});
    s.velocity.push_back({1.0 / 3.0, time, -i * 1e-300});
    s.temperature.push_back(300.0 + i);
    s.mass.push_back(0.5);
    s.id.push_back(i);
    s.phase.push_back(2);
    s.body.push_back(0);
    s.material.push_back(0);
  }
  for (int b = 0; b < bodies; ++b)
    s.bodies.push_back({{time, 0, 0},
                        {0, 1, 0},
                        {0, 0, 2},
                        {std::cos(time), 0, 0, std::sin(time)},
                        0.5 * particles,
                        {},
                        {0, 0, 1}});
  s.total_mass = 0.5 * particles;
  s.energy["kinetic"] = 1.0 + time;
  s.heat_given["hot plate"] = 7.0 * time;
  return s;
}

TEST_F(Io, FramesOfAPeriodicDomainAreReadBackAsOthersAre) {
  Domain domain;
  domain.min = {0.0, -1.0, -std::numeric_limits<double>::infinity()};
  domain.max = {3.0, 1.0, std::numeric_limits<double>::infinity()};
  domain.periodic = {true, false, false};
  for (const auto& [name, of] : {std::pair{"open.h5", Domain{}}, std::pair{"periodic.h5", domain}}) {
    TrajectoryWriter writer(path(name), of);
    writer.append(frame_at(0.0, 5, 1));
    writer.append(frame_at(1.0, 5, 1));
    writer.close();
  }
  const Trajectory open = read_trajectory(path("open.h5")), periodic = read_trajectory(path("periodic.h5"));
  ASSERT_EQ(open.frames.size(), 2U);
  ASSERT_EQ(periodic.frames.size(), 2U);
  for (std::size_t f = 0; f < 2; ++f) EXPECT_EQ(state_hash(open.frames[f]), state_hash(periodic.frames[f]));
}

TEST_F(Io, ACsvWithTwoRowsForOneBodyOrParticleAtATimeIsRefused) {
  InitialState initial;
  initial.position = {{0, 0, 0}, {1, 0, 0}};
  initial.velocity = {{}, {}};
  initial.mass = {1.0, 1.0};
  initial.phase = {2, 2};
  initial.body = {0, 0};
  initial.material = {0, 0};
  initial.source = {0, 0};
  const auto refusal = [&](const std::string& text) -> std::string {
    std::ofstream(path("trajectory.csv")) << text;
    try {
      (void)read_trajectory_csv(path("trajectory.csv"), initial, 1);
      return "";
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(refusal("time,body,x,y,z,vx,vy,vz\n0,0,0.5,0,0,0,0,0\n1,0,0.5,0,0,0,0,0\n"), "");
  EXPECT_NE(refusal("time,body,x,y,z,vx,vy,vz\n0,0,0.5,0,0,0,0,0\n0,0,9.5,0,0,0,0,0\n")
                .find("trajectory.csv:3: body 0 has a row already"),
            std::string::npos);
  EXPECT_NE(refusal("time,id,x,y,z,vx,vy,vz\n0,0,0.5,0,0,0,0,0\n0,0,9.5,0,0,0,0,0\n")
                .find("particle 0 has a row already"),
            std::string::npos);
}

TEST_F(Io, ACsvOfBodiesWithoutTurningDoesNotTurn) {
  InitialState initial;
  initial.position = {{0, 0, 0}, {1, 0, 0}};
  initial.velocity = {{}, {}};
  initial.mass = {1.0, 1.0};
  initial.phase = {2, 2};
  initial.body = {0, 0};
  initial.material = {0, 0};
  initial.source = {0, 0};
  std::ofstream(path("trajectory.csv")) << "time,body,x,y,z,vx,vy,vz\n0,0,0.5,0,0,1,2,3\n";
  const auto frame = read_trajectory_csv(path("trajectory.csv"), initial, 1).frames.at(0);
  EXPECT_EQ(frame.bodies[0].angular_velocity, Vec3{});
  EXPECT_TRUE(std::isnan(frame.bodies[0].force.x + frame.bodies[0].torque.x)) << "not shown is not 0";
  EXPECT_EQ(frame.velocity[1], (Vec3{1, 2, 3}));
}

TEST_F(Io, ATrajectoryReadsBackBitForBit) {
  TrajectoryWriter writer(path("trajectory.h5"));
  for (const double t : {0.0, 0.1, 0.2}) writer.append(frame_at(t, 5, 2));
  EXPECT_EQ(writer.frames(), 3);
  writer.close();
  const Trajectory read = read_trajectory(path("trajectory.h5"));
  ASSERT_EQ(read.frames.size(), 3U);
  const Snapshot& last = read.frames[2];
  const Snapshot wrote = frame_at(0.2, 5, 2);
  EXPECT_EQ(state_hash(last), state_hash(wrote));
  EXPECT_EQ(last.step, 2);
  EXPECT_EQ(last.mass, wrote.mass);
  EXPECT_EQ(last.id, wrote.id);
  EXPECT_EQ(last.energy.at("kinetic"), 1.2);
  EXPECT_EQ(last.bodies[1].torque.z, 1.0);
  EXPECT_EQ(last.heat_given, wrote.heat_given);
}

TEST_F(Io, EveryNumberOfABodyReadsBackInItsPlace) {
  Snapshot wrote = frame_at(0.0, 2, 0);
  for (const double b : {0.0, 100.0})
    wrote.bodies.push_back({{b + 1, b + 2, b + 3},
                            {b + 4, b + 5, b + 6},
                            {b + 7, b + 8, b + 9},
                            {b + 10, b + 11, b + 12, b + 13},
                            b + 14,
                            {b + 15, b + 16, b + 17},
                            {b + 18, b + 19, b + 20}});
  wrote.momentum = {21, 22, 23};
  wrote.angular_momentum = {24, 25, 26};
  TrajectoryWriter writer(path("trajectory.h5"));
  writer.append(wrote);
  writer.close();
  const Snapshot read = read_trajectory(path("trajectory.h5")).frames.at(0);
  ASSERT_EQ(read.bodies.size(), 2U);
  for (std::size_t b = 0; b < 2; ++b) {
    const BodyState &a = read.bodies[b], &w = wrote.bodies[b];
    EXPECT_EQ(a.position, w.position);
    EXPECT_EQ(a.velocity, w.velocity);
    EXPECT_EQ(a.angular_velocity, w.angular_velocity);
    EXPECT_EQ(a.orientation, w.orientation);
    EXPECT_EQ(a.mass, w.mass);
    EXPECT_EQ(a.force, w.force);
    EXPECT_EQ(a.torque, w.torque);
  }
  EXPECT_EQ(read.position, wrote.position);
  EXPECT_EQ(read.velocity, wrote.velocity);
  EXPECT_EQ(read.total_mass, wrote.total_mass);
}

TEST_F(Io, ParticlesThatComeLaterLeaveEarlierFramesEmpty) {
  TrajectoryWriter writer(path("trajectory.h5"));
  writer.append(frame_at(0.0, 2, 1));
  writer.append(frame_at(1.0, 4, 3));
  writer.close();
  const Trajectory read = read_trajectory(path("trajectory.h5"));
  EXPECT_EQ(read.frames[0].position.size(), 4U);
  EXPECT_EQ(read.frames[0].id[3], -1);
  EXPECT_TRUE(std::isnan(read.frames[0].temperature[3]));
  EXPECT_TRUE(std::isnan(read.frames[0].bodies[2].mass));
  EXPECT_EQ(read.frames[1].id[3], 3);
}

TEST_F(Io, AFrameThatWasAnnouncedIsReadableWhileTheWriterIsStillOpen) {
  TrajectoryWriter writer(path("trajectory.h5"));
  writer.append(frame_at(0.0, 3, 1));
  writer.append(frame_at(0.5, 3, 1));
  std::filesystem::copy_file(path("trajectory.h5"), path("killed.h5"));  // what a killed process would leave
  EXPECT_EQ(read_trajectory(path("killed.h5")).frames.size(), 2U);
}

TEST_F(Io, AFileOfAnotherKindIsRefusedByName) {
  std::ofstream(path("noise.h5")) << "no HDF5 at all";
  EXPECT_THROW((void)read_trajectory(path("noise.h5")), InputError);
  EXPECT_THROW((void)read_trajectory(path("absent.h5")), InputError);
}

TEST_F(Io, ADamagedFrameIsRefusedByItsChecksum) {
  {
    TrajectoryWriter writer(path("trajectory.h5"));
    writer.append(frame_at(0.25, 400, 1));
  }
  std::string bytes;
  {
    std::ifstream in(path("trajectory.h5"), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const double marker = 0.25 + 200;  // x of particle 200
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&marker), 8));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  std::ofstream(path("trajectory.h5"), std::ios::binary) << bytes;
  EXPECT_THROW((void)read_trajectory(path("trajectory.h5")), InputError);
}

TEST_F(Io, AFrameThatIsTornEndsTheTrajectoryAndLosesNoneBeforeIt) {
  {
    TrajectoryWriter writer(path("trajectory.h5"));
    for (const double t : {0.25, 0.5, 0.75, 1.0}) writer.append(frame_at(t, 400, 1));
  }
  std::string bytes;
  {
    std::ifstream in(path("trajectory.h5"), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const double marker = 0.75 + 200;  // x of particle 200 in the third frame
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&marker), 8));
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  std::ofstream(path("trajectory.h5"), std::ios::binary) << bytes;
  const Trajectory read = read_trajectory(path("trajectory.h5"));
  ASSERT_EQ(read.frames.size(), 2U);
  EXPECT_EQ(state_hash(read.frames[1]), state_hash(frame_at(0.5, 400, 1)));
}

TEST_F(Io, RowsOfABodyPlaceItsParticles) {
  InitialState start;
  start.position = {{-1, 0, 0}, {1, 0, 0}};
  start.velocity = {{}, {}};
  start.mass = {1, 1};
  start.phase = {2, 2};
  start.body = {0, 0};
  start.material = {0, 0};
  std::ofstream(path("trajectory.csv"))
      << "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz\n0,0,0,0,0,0,0,0,1,0,0,0,0,0,2\n"
         "1,0,5,0,0,1,0,0,0.7071067811865476,0,0,0.7071067811865476,0,0,2\n";
  const Trajectory t = read_trajectory_csv(path("trajectory.csv"), start, 1);
  ASSERT_EQ(t.frames.size(), 2U);
  EXPECT_NEAR(t.frames[1].position[1].y, 1.0, 1e-15);        // a quarter turn takes x to y
  EXPECT_NEAR(t.frames[1].velocity[1].x, 1.0 - 2.0, 1e-15);  // v + omega x r
}

TEST_F(Io, ACsvCellThatIsNoNumberIsRefusedWithItsLine) {
  InitialState start;
  start.position = start.velocity = {{}};
  start.mass = {1};
  start.phase = start.body = start.material = {0};
  std::ofstream(path("trajectory.csv")) << "time,id,x,y,z,vx,vy,vz\n0,0,zero,0,0,0,0,0\n";
  try {
    (void)read_trajectory_csv(path("trajectory.csv"), start, 0);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("trajectory.csv:2"), std::string::npos) << e.what();
  }
}

TEST_F(Io, ACsvHeaderThatNamesAColumnTwiceIsRefused) {
  InitialState start;
  start.position = start.velocity = {{}};
  start.mass = {1};
  start.phase = start.body = start.material = {0};
  std::ofstream(path("trajectory.csv")) << "time,id,x,y,z,vx,vy,vz,x\n0,0,0,0,0,0,0,0,0\n";
  EXPECT_THROW((void)read_trajectory_csv(path("trajectory.csv"), start, 0), InputError);
}

/// Each once made a reader die, or take 16 GiB.
TEST_F(Io, DamagedTrajectoriesAreRefusedOrEmpty) {
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(DAMAGED_FILES)) {
    ++files;
    try {
      EXPECT_TRUE(read_trajectory(file.path().string()).frames.empty()) << file.path();
    } catch (const InputError&) {  // named
    } catch (const EngineError&) {
    }
  }
  EXPECT_GE(files, 6);
}

TEST_F(Io, GaugesMakeFramesOfTheirOwnAndJoinThoseThatAreThere) {
  std::ofstream(path("gauges.csv")) << "time,gauge,value\n0,0,1.5\n0,1,300\n0.5,0,2.5\n0.5,1,310\n";
  Trajectory alone, beside;
  beside.frames.push_back(frame_at(0.0, 4, 1));
  beside.frames.push_back(frame_at(0.5, 4, 1));
  for (Trajectory* t : {&alone, &beside}) read_gauges_csv(path("gauges.csv"), {"tip", "middle"}, *t);
  ASSERT_EQ(alone.frames.size(), 2U);
  ASSERT_EQ(beside.frames.size(), 2U);
  EXPECT_TRUE(alone.frames[1].gauges_only());
  EXPECT_FALSE(beside.frames[1].gauges_only());
  for (const Trajectory* t : {&alone, &beside})
    EXPECT_EQ(t->frames[1].gauges, (std::map<std::string, double>{{"tip", 2.5}, {"middle", 310.0}}));
  EXPECT_NE(state_hash(beside.frames[1]), state_hash(frame_at(0.5, 4, 1)));
}

TEST_F(Io, AGaugeMayStateItsStandardError) {
  std::ofstream(path("gauges.csv")) << "time,gauge,value,standard_error\n0.5,0,2.5,0.125\n";
  Trajectory t;
  read_gauges_csv(path("gauges.csv"), {"tip"}, t);
  ASSERT_EQ(t.frames.size(), 1U);
  EXPECT_EQ(t.frames[0].gauges.at(gauge_error_key("tip")), 0.125);
  std::ofstream(path("gauges.csv")) << "time,gauge,value,standard_error\n0.5,0,2.5,-0.125\n";
  EXPECT_THROW(read_gauges_csv(path("gauges.csv"), {"tip"}, t), InputError);
}

TEST_F(Io, AGaugeThatTheJobDoesNotHaveOrThatIsNotFiniteIsRefusedWithItsLine) {
  for (const char* bad : {"0,2,1.0", "0,0,nan", "0,0,1.0\n0,0,1.0"}) {
    std::ofstream(path("gauges.csv")) << "time,gauge,value\n0,1,5\n" << bad << "\n";
    Trajectory t;
    try {
      read_gauges_csv(path("gauges.csv"), {"tip", "middle"}, t);
      FAIL() << "accepted " << bad;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("gauges.csv:"), std::string::npos) << e.what();
    }
  }
}

TEST_F(Io, ParticlesReadBackWithTheirSources) {
  InitialState s;
  s.position = {{0, 0, 0}, {1, 0, 0}};
  s.velocity = {{1, 2, 3}, {}};
  s.mass = {1, 2};
  s.temperature = {300, 400};
  s.phase = {2, 0};
  s.body = {0, -1};
  s.material = {0, 1};
  s.source = {0, 1};
  write_particles(path("particles.h5"), s);
  const InitialState r = read_particles(path("particles.h5"));
  EXPECT_EQ(r.position, s.position);
  EXPECT_EQ(r.velocity, s.velocity);
  EXPECT_EQ(r.body, s.body);
  EXPECT_EQ(r.source, s.source);
  EXPECT_EQ(r.temperature, s.temperature);
}

}  // namespace
}  // namespace tripoint
