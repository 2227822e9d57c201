// SPDX-License-Identifier: BSD-3-Clause
// The example of a foreign engine, in Python: it flies, and a wrong constant in it can be seen.
#include <gtest/gtest.h>

#include "adapters/process.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {
namespace {

const std::string engine = ENGINE_PYTHON;
const Vec3 g{0, 0, -9.81};

double position_error(const std::string& program) {
  const Vec3 v{1, 0, 5};
  const test::Prepared p = test::block({v, {}}, g, 1.0, 4, 0.01);
  double worst = 0.0;
  for (const Snapshot& s : test::run(program, p).trajectory.frames)
    worst = std::max(worst, norm(s.bodies[0].position - p.job.bodies[0].properties.centre - s.time * v -
                                 (0.5 * s.time * s.time) * g));
  return worst;
}

TEST(PythonEngine, FollowsTheParabola) { EXPECT_LT(position_error(engine), 1e-13); }

TEST(PythonEngine, WithGravityWrongByOnePercentMissesByOnePercent) {
  const test::Folder folder;
  const std::string copy = folder.at("engine-wrong");
  ASSERT_EQ(test::shell("sed 's/^GRAVITY_FACTOR = 1.0 /GRAVITY_FACTOR = 1.01 /' '" + engine + "' > '" + copy +
                        "' && chmod +x '" + copy + "'"),
            0);
  EXPECT_NEAR(position_error(copy), 0.01 * 0.5 * 9.81, 1e-12);
}

TEST(PythonEngine, TurnsAnAsymmetricBody) {
  const Vec3 w{1, 2, 3};
  const test::Prepared p = test::block({{}, w}, {}, 2.0, 2, 0.01);
  const auto& m = p.job.bodies[0].properties;
  const auto out = test::run(engine, p);
  ASSERT_EQ(out.exit_code, 0);
  EXPECT_LT(angle_between(out.trajectory.frames.back().bodies[0].orientation,
                          TorqueFree(m.principal_inertia, m.principal_axes, w).rotation(2.0)),
            1e-9)
      << "fourth order at 1 ms";
}

TEST(PythonEngine, RefusesHeatAndEndsOnABrokenJobAsTheContractSays) {
  TemperatureField f;
  f.value = 300.0;
  EXPECT_EQ(test::run(engine, test::bar(8, 8e-3, f, true, 1.0, 1)).exit_code, 4);
  EXPECT_EQ(test::run_broken_job(engine), 2);
}

}  // namespace
}  // namespace tripoint
