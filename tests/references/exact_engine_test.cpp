// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/exact/exact_engine.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "references/scenes.hpp"

namespace tripoint {
namespace {

/// The job's particles in a file of their own, as the harness leaves them.
class ExactEngineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    s_ = test::block({1, 2, 3}, 1.0, 4);
    s_.job.reference = test::function("torque_free");
    file_ = std::filesystem::temp_directory_path() / ("exact_engine_" + std::to_string(::getpid()) + ".h5");
    write_particles(file_.string(), s_.initial);
    s_.job.particles = file_.string();
  }
  void TearDown() override { std::filesystem::remove(file_); }
  test::Prepared s_;
  std::filesystem::path file_;
};

TEST_F(ExactEngineTest, ServesTheTruthAtEveryTime) {
  ExactEngine engine;
  ASSERT_EQ(engine.refusal(s_.job), "");
  engine.load(s_.job, read_particles(s_.job.particles));
  const auto truth = make_reference(s_.job.reference, s_.job, s_.initial);
  for (const double t : s_.job.times) {
    engine.advance_to(t);
    const auto frame = engine.observe(), exact = truth->at(t);
    EXPECT_EQ(frame.time, t);
    EXPECT_EQ(frame.position, exact.position);
    EXPECT_EQ(frame.id.size(), s_.initial.size());
    EXPECT_NEAR(frame.energy.at("kinetic"), 0.5 * (0.67 / 6.0 + 0.095 * 4 + 9.0 / 24.0),
                1e-14);  // I = (0.11167, 0.095, 0.041667), w = (1, 2, 3)
  }
  EXPECT_NEAR(engine.readback().bodies.at(0).mass, 1.0, 1e-14);
}

TEST_F(ExactEngineTest, PlacesTheParticlesOfBodiesThatTheReferenceKnows) {
  s_ = {};
  s_.job.scene.spacing = 0.1;
  s_.job.scene.gravity = {0, 0, -9.81};
  s_.job.settings["friction"] = 0.25;
  test::add_body(s_, "block", {{4, 4, 2}, 0.1, {}, 4.0}, {{1, 0, 0}, {}});
  test::add_body(s_, "floor", {{20, 4, 1}, 0.1, {-0.5, 0.0, -0.1}, 1.0}, {}, Motion::fixed);
  test::set_times(s_, 0.2, 2);
  s_.job.reference = test::function("sliding");
  s_.job.particles = file_.string();
  write_particles(file_.string(), s_.initial);
  ExactEngine engine;
  ASSERT_EQ(engine.refusal(s_.job), "");
  engine.load(s_.job, s_.initial);
  engine.advance_to(0.2);
  const auto frame = engine.observe();
  const double v = 1.0 - 0.25 * 9.81 * 0.2;
  EXPECT_NEAR(frame.velocity[3].x, v, 1e-15);
  EXPECT_NEAR(frame.position[3].x - s_.initial.position[3].x, 0.2 - 0.5 * 0.25 * 9.81 * 0.04, 1e-15);
  EXPECT_EQ(frame.position.back(), s_.initial.position.back()) << "the floor stays";
}

TEST_F(ExactEngineTest, RefusesInTheReferencesOwnWords) {
  ExactEngine engine;
  s_.job.reference = test::function("invariant");
  EXPECT_NE(engine.refusal(s_.job).find("not particle positions"), std::string::npos);
  s_.job.reference = test::function("cosine_mode");
  EXPECT_NE(engine.refusal(s_.job), "");
  s_.job.reference = test::function("no_such_function");
  EXPECT_NE(engine.refusal(s_.job).find("unknown reference function"), std::string::npos);
}

}  // namespace
}  // namespace tripoint
