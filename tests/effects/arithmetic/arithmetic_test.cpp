// SPDX-License-Identifier: BSD-3-Clause
// A form of a term that the program has, as one folder, one line and one case.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "assembly/plan.hpp"
#include "files/scene_json.hpp"
#include "sampling/sample.hpp"
#include "scene/model.hpp"
#include "scene/shared_terms.hpp"
#include "step/simulation.hpp"
#include "validation/case/ablation.hpp"
#include "validation/case/read_case.hpp"
#include "validation/case/schema.hpp"

namespace tripoint {
namespace {

const std::string case_file =
    std::string(TRIPOINT_SOURCE_DIR) + "/tests/effects/arithmetic/two-viscosities.toml";

Scene sheared(const std::string& viscosity = "arithmetic", const std::vector<std::string>& set = {}) {
  std::vector<std::string> all = set;
  all.push_back("model.viscosity=\"" + viscosity + "\"");
  return scene_for(read_case(case_file, all).value, {});
}

/// Kinetic energy at the end less that of the start [J].
double rubbed_off(const Scene& scene) {
  Simulation s(scene, sample(scene));
  const double before = s.ledger().energy.at("kinetic");
  s.advance_to(scene.end_time);
  return before - s.ledger().energy.at("kinetic");
}

bool is_on(const Scene& scene) {
  const Plan p = plan(scene);
  return std::ranges::find(p.effects, "arithmetic", &PlannedEffect::name) != p.effects.end();
}

TEST(AddedEffectForm, IsOnWhereItsWordStandsAndNowhereElse) {
  EXPECT_TRUE(is_on(sheared()));
  for (const char* other : {"central", "morris", "isotropic", "paper"})
    EXPECT_FALSE(is_on(sheared(other))) << other;
}

TEST(AddedEffectForm, BringsItsWordToTheReaderTheJobTheSchemaAndThePage) {
  EXPECT_NE(case_reference_page().find("`morris` `arithmetic` `paper`"), std::string::npos);
  EXPECT_NE(case_schema().find("\"arithmetic\""), std::string::npos);
  const Scene sent = sheared();
  Scene received;
  std::vector<JobBody> bodies(sent.bodies.size());
  scene_from_json(scene_to_json(sent, bodies), received, bodies);
  EXPECT_TRUE(received.takes_form(term::viscosity, "arithmetic"));
  EXPECT_FALSE(sheared("paper").has_brought_form(term::viscosity));
}

TEST(AddedEffectForm, IsTheOneThatActs) {
  const std::vector<std::string> alike{"material.thick.viscosity=1"};
  const double exact = 0.073327;  // [J], fluid/two-viscosities
  EXPECT_NEAR(rubbed_off(sheared()) / exact, 1.08, 0.02) << "the defect that the case states";
  EXPECT_NEAR(rubbed_off(sheared("morris")) / exact, 1.0, 0.02);
  EXPECT_NEAR(rubbed_off(sheared("arithmetic", alike)) / rubbed_off(sheared("morris", alike)), 1.0, 1e-9)
      << "means of equal viscosities are equal: round-off, and steps of one length";
}

TEST(AddedEffectForm, HasItsRowsOfAblation) {
  const Case value = corrected(read_case(case_file).value);
  std::set<std::string> rows;
  for (const Correction& one : corrections())
    if (can_act(one, scene_for(value, {}))) rows.insert(one.name);
  EXPECT_TRUE(rows.contains("viscosity")) << "its printed form";
  EXPECT_TRUE(rows.contains("viscosity=central")) << "the usual one";
}

}  // namespace
}  // namespace tripoint
