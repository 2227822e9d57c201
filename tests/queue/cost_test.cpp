// SPDX-License-Identifier: BSD-3-Clause
// What a run is expected to cost: by which bound its steps are counted.
#include "validation/queue/cost.hpp"

#include <gtest/gtest.h>

#include "files/job.hpp"
#include "scene/effect_rule.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace {

/// A shipped case at its own resolution, without frames, which cost something too.
Job job_of(const std::string& id) {
  Job job;
  const Case value = read_case(std::string(TRIPOINT_SOURCE_DIR) + "/cases/" + id + ".toml").value;
  job.scene = scene_for(value, {Mode::corrected, {}, {}, {}, {}, {}});
  job.resolution.spacing = job.scene.spacing;
  job.resolution.support_ratio = job.scene.support_ratio;
  return job;
}

/// Seconds of stepping: what a thousand particles cost more than none.
double stepping(const Job& job) {
  return predicted_cost(job, "tripoint", 1000) - predicted_cost(job, "tripoint", 0);
}

TEST(PredictedCost, OfWhatStandsAndConductsIsByItsHeat) {
  // The wax of its library has a Young's modulus, and nothing of it bends
  Job job = job_of("hard/latent-100");
  ASSERT_TRUE(calls_for(job.scene, "heat"));
  ASSERT_FALSE(calls_for(job.scene, "elastic"));
  job.scene.end_time = 1e6;
  const double as_it_is = stepping(job);
  for (Material& m : job.scene.materials) m.young_modulus = 1e12;
  EXPECT_EQ(stepping(job), as_it_is);
  for (Material& m : job.scene.materials) m.conductivity = 2.0 * *m.conductivity;
  EXPECT_NEAR(stepping(job), 2.0 * as_it_is, 1e-9 * as_it_is);
}

TEST(PredictedCost, KnowsThatWhatIsHeldAtATemperatureBoundsNoStep) {
  Job job = job_of("phase/stefan");  // its plate conducts a million times as well as what melts
  const double as_it_is = stepping(job);
  for (Body& b : job.scene.bodies) b.temperature_held = false;
  EXPECT_GT(stepping(job), 1e4 * as_it_is);
}

TEST(PredictedCost, OfWhatBendsIsByItsSound) {
  Job job = job_of("solid/tension");
  const double as_it_is = stepping(job);
  for (Material& m : job.scene.materials)
    if (m.young_modulus) m.young_modulus = 4.0 * *m.young_modulus;
  EXPECT_NEAR(stepping(job), 2.0 * as_it_is, 1e-9 * as_it_is);
}

TEST(PredictedCost, FollowsAStepThatIsGiven) {
  Job job = job_of("solid/tension");
  job.resolution.time_step = job.scene.end_time / 1000.0;
  const double as_it_is = stepping(job);
  job.resolution.time_step = job.scene.end_time / 2000.0;
  EXPECT_NEAR(stepping(job), 2.0 * as_it_is, 1e-9 * as_it_is);
}

}  // namespace
}  // namespace tripoint
