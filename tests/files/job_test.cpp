// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "files/job.hpp"
#include "files/result.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint {
namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + name)).string();
}

Job example_job() {
  Job job;
  job.case_id = "heat/example";
  Scene& s = job.scene;
  s.end_time = 1.0 / 3.0;
  s.gravity = {0, 0, -9.81};
  s.spacing = 0.1;
  s.periodic = {true, false, false};
  s.min = Vec3{0, 0, 0};
  s.set_all_modes(Mode::corrected);
  s.modes[term::heat] = Mode::paper;
  Material m;
  m.name = "water";
  m.density = 1000.0;
  m.conductivity = 0.6;
  m.solid_conductivity = 2.2;
  m.solid_heat_capacity = 2100.0;
  s.materials.push_back(m);
  Body b;
  b.name = "bar";
  b.material = "water";
  b.phase = Phase::rigid;
  b.motion = Motion::fixed;
  b.temperature = TemperatureField{};
  b.temperature->kind = TemperatureField::Kind::cosine;
  b.temperature->wave_vector = {6.28, 0, 0};
  b.shape.kind = Shape::Kind::difference;
  b.shape.of = {Shape{}, Shape{}};
  b.shape.of[1].kind = Shape::Kind::sphere;
  b.shape.of[1].radius = 0.25;
  b.velocity.kind = VelocityField::Kind::linear;
  b.velocity.gradient[1] = {1, 2, 3};
  s.bodies.push_back(b);
  Event e;
  e.kind = Event::Kind::split;
  e.time = 0.5;
  e.name = "half";
  e.region = Shape{};
  s.events.push_back(e);
  JobBody j;
  j.name = "bar";
  j.material = "water";
  j.index = 0;
  j.properties = {1.5, {0.5, 0, 0}, {1, 2, 3}, {}};
  job.bodies.push_back(j);
  job.particles = "particles.h5";
  job.resolution = {0.1, 2.6, 0.01, {}, {}};
  job.settings = {{"walkers", 1e5},
                  {"form", std::string("brownian")},
                  {"quick", true},
                  {"list", std::vector<double>{1, 2}}};
  job.reference.function = "cosine_mode";
  job.times = {0.0, 0.1, 1.0 / 3.0};
  job.output = "out";
  return job;
}

TEST(Job, ReadsBackWhatWasWritten) {
  const std::string path = temporary("job.json");
  write_job(path, example_job());
  const Job read = read_job(path);
  std::filesystem::remove(path);
  Job expected = example_job();
  const std::string folder = std::filesystem::path(path).parent_path().string() + "/";
  expected.particles = folder + "particles.h5";
  expected.output = folder + "out";
  EXPECT_EQ(job_text(read), job_text(expected));
  EXPECT_EQ(read.scene.mode_of(term::heat), Mode::paper);
  EXPECT_EQ(read.scene.materials[0].solid_conductivity, 2.2);
  EXPECT_EQ(read.scene.materials[0].solid_heat_capacity, 2100.0);
  EXPECT_EQ(read.times.back(), 1.0 / 3.0);  // numbers travel without loss
  EXPECT_EQ(read.scene.bodies[0].velocity.gradient[1].z, 3.0);
  EXPECT_EQ(read.scene.bodies[0].shape.of[1].radius, 0.25);
  EXPECT_EQ(read.scene.events[0].kind, Event::Kind::split);
}

TEST(Job, NamesTheKeyThatIsMissing) {
  const std::string path = temporary("broken.json");
  std::ofstream(path) << R"({"contract": 1, "case": "a/b", "scene": {"end_time": "soon"}})";
  try {
    (void)read_job(path);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("scene.end_time"), std::string::npos) << e.what();
  }
  std::filesystem::remove(path);
}

TEST(Job, RefusesTextThatIsNoJson) {
  const std::string path = temporary("cut.json");
  std::ofstream(path) << "{";
  EXPECT_THROW((void)read_job(path), InputError);
  std::filesystem::remove(path);
}

TEST(Result, AStatusThatIsNotAnEnginesOwnIsRefusedByName) {
  const std::string path = temporary("status.json");
  for (const std::string word : {"OK", "fine", "killed", "missing", ""}) {
    std::ofstream(path) << R"({"contract": 1, "status": ")" << word << "\"}";
    try {
      (void)read_result(path);
      ADD_FAILURE() << word;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("status: `" + word + "` is none that an engine may give"),
                std::string::npos)
          << e.what();
    }
  }
  std::filesystem::remove(path);
}

TEST(Result, ReadsBackWhatWasWritten) {
  Result r;
  r.status = Status::diverged;
  r.message = "particle 7: velocity is not finite";
  r.steps = 12;
  r.pairs = 3e9;
  r.divergence = Divergence{7, 1, "velocity", "kick", 0.25, "not_finite", "culprits.vtu", "checkpoint.h5"};
  r.readback.bodies.push_back({"cube", 2.0, {1, 2, 3}, {4, 5, 6}, 0, 0, 0, 0});
  r.extra["angle"] = 0.5;
  const std::string path = temporary("result.json");
  write_result(path, r);
  const Result read = read_result(path);
  std::filesystem::remove(path);
  EXPECT_EQ(read.status, r.status);
  EXPECT_EQ(read.message, r.message);
  EXPECT_EQ(read.pairs, 3e9);
  EXPECT_EQ(read.divergence->field, "velocity");
  EXPECT_EQ(read.divergence->guard, "not_finite");
  EXPECT_EQ(read.divergence->file, "culprits.vtu");
  EXPECT_EQ(read.divergence->checkpoint, "checkpoint.h5");
  EXPECT_EQ(read.readback.bodies[0].principal_inertia, (Vec3{4, 5, 6}));
  EXPECT_EQ(read.extra.at("angle"), 0.5);
}

}  // namespace
}  // namespace tripoint
