// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "effects/lab.hpp"
#include "pairs/scene_passes.hpp"

namespace tripoint {
namespace {

TEST(Plan, OfARigidSceneHasNoHeatColumnAndNeitherHasTheRun) {
  const lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  const Plan p = plan(lab.scene);
  ASSERT_EQ(p.effects.size(), 1u);
  EXPECT_EQ(p.effects[0].name, "rigid");
  for (const char* f : {"temperature", "enthalpy", "heat_rate", "conductivity", "density"})
    EXPECT_FALSE(lab::lists(p, f)) << f;
  const Simulation s(lab.scene, lab.initial);
  EXPECT_THROW((void)s.state().particles[field::temperature], MissingField);
  EXPECT_FALSE(s.state().neighbours.has_value()) << "a scene without pair terms needs no lists";
}

lab::Lab warm(Mode mode) {
  lab::Lab lab(0.01, mode);
  lab.add({.count = {4, 4, 4}, .motion = Motion::fixed, .temperature = [](const Vec3&) { return 300.0; }});
  return lab;
}

TEST(Plan, OfASceneWithoutDeformableSolidsHasNoneOfTheirColumnsAndNoBonds) {
  lab::Lab lab = lab::asymmetric_block({1.0, 2.0, 3.0});
  lab.scene.materials[0].stiffness = 100.0;
  lab.add({.name = "pool", .corner = {1.0, 0.0, 0.0}, .count = {4, 4, 4}, .phase = Phase::liquid});
  const Plan p = plan(lab.scene);
  for (const char* f :
       {"elastic_force.x", "shape_rank", "strain.xx", "own_density", "plastic_strain.xx", "liquid_fraction"})
    EXPECT_FALSE(lab::lists(p, f)) << f;
  for (const PlannedEffect& e : p.effects)
    EXPECT_TRUE(e.name != "elastic" && e.name != "plastic" && e.name != "fracture" && e.name != "phase")
        << e.name;
  const Simulation s = lab.run(0.01);
  EXPECT_EQ(s.state().bonds.particles(), 0u);
  EXPECT_EQ(s.state().own.particles(), 0u);
}

TEST(Plan, OfHeatOwnsEachFormsOwnFields) {
  const Plan corrected = plan(warm(Mode::corrected).scene), paper = plan(warm(Mode::paper).scene);
  EXPECT_TRUE(lab::lists(corrected, "enthalpy"));
  EXPECT_FALSE(lab::lists(corrected, "density"));
  EXPECT_FALSE(lab::lists(paper, "enthalpy"));
  EXPECT_TRUE(lab::lists(paper, "density"));
  EXPECT_EQ(corrected.effects.back().mode, "corrected");
  EXPECT_EQ(paper.effects.back().mode, "paper");
  EXPECT_GT(corrected.bytes_per_particle, paper.bytes_per_particle);
}

TEST(Plan, ListsExactlyTheColumnsThatTheRunHas) {
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    const lab::Lab lab = warm(mode);
    const Plan p = plan(lab.scene);
    const Simulation s(lab.scene, lab.initial);
    std::size_t columns = s.state().particles.fields().size() + s.state().bodies.fields().size();
    EXPECT_EQ(columns, p.fields.size());
    for (const auto& f : s.state().particles.fields()) EXPECT_TRUE(lab::lists(p, f.name)) << f.name;
  }
}

TEST(Passes, RefuseAPairTermThatReadsAFieldWhichItsEffectDoesNotDeclare) {
  const lab::Lab lab = warm(Mode::corrected);
  std::vector<Active> effects = active_effects(lab.scene);
  EXPECT_NO_THROW(Passes(lab.scene, pair_work(lab.scene, effects), 1));
  const auto heat = std::ranges::find(effects, "heat", &Active::name);
  ASSERT_NE(heat, effects.end());
  std::erase(heat->declared.keys, field::temperature.key);
  try {
    const Passes passes(lab.scene, pair_work(lab.scene, effects), 1);
    ADD_FAILURE() << "it was accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "a pair term of the effect heat reads or adds to the field temperature, which the effect "
                 "does not declare");
  }
}

TEST(Heat, WithoutAHeatCapacityNamesTheMaterial) {
  lab::Lab lab = warm(Mode::corrected);
  lab.add_material(2000.0, 1.0, 1.0);
  lab.scene.materials[1].heat_capacity.reset();
  lab.add({.name = "other",
           .material = 1,
           .corner = {1.0, 0.0, 0.0},
           .count = {2, 2, 2},
           .motion = Motion::fixed,
           .temperature = [](const Vec3&) { return 300.0; }});
  try {
    const Simulation s(lab.scene, lab.initial);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("material m1"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tripoint
