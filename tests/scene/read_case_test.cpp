// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "full_case.hpp"
#include "sampling/sample.hpp"
#include "scene/shared_terms.hpp"
#include "validation/case/ablation.hpp"

namespace tripoint::test {
namespace {

using testing::Test;

TEST(ReadCase, SixLinesRunOnDefaultsAndEachDefaultHasItsReason) {
  const auto r = read_text(six_lines);
  EXPECT_DOUBLE_EQ(r.value.scene.spacing, 0.04);
  EXPECT_DOUBLE_EQ(r.value.scene.output_interval, 0.05);
  EXPECT_EQ(r.value.scene.bodies[0].phase, Phase::rigid);
  EXPECT_EQ(r.value.scene.material("steel").density, 7850.0);
  EXPECT_EQ(r.value.scene.support_ratio, 2.6);
  EXPECT_GT(r.decisions.size(), 60U);
  for (const auto& d : r.decisions) {
    EXPECT_FALSE(d.reason.empty()) << d.key;
    EXPECT_TRUE(!d.given || d.place.line > 0) << d.key;
  }
  EXPECT_NE(decision(r, "scene.spacing")->reason.find("a tenth of the smallest extent, 0.4 m of body block"),
            std::string::npos);
  EXPECT_EQ(sample(scene_for(r.value, {})).size(), 1000U);
}

TEST(ReadCase, ReadsEveryKeyOfTheContract) {
  const auto r = read_text(full_case);
  const Case& c = r.value;
  EXPECT_EQ(c.id, "test/full");
  EXPECT_EQ(c.modes, (std::vector<Mode>{Mode::corrected, Mode::paper}));
  EXPECT_EQ(c.scene.mode_of(term::heat), Mode::paper);
  EXPECT_EQ(c.scene.mode_of(term::kernel), Mode::corrected);
  EXPECT_EQ(c.scene.support_ratio, 2.6);
  EXPECT_EQ(*c.scene.time_step, 1e-3);
  EXPECT_TRUE(c.scene.periodic[0]);
  EXPECT_EQ(*c.scene.material("goo").stiffness, 400.0);
  EXPECT_EQ(*c.scene.material("goo").t_solid, 320.0);
  EXPECT_EQ(c.scene.bodies.size(), 5U);
  EXPECT_EQ(c.scene.body("pool").velocity.kind, VelocityField::Kind::linear);
  EXPECT_EQ(c.scene.body("pool").velocity.gradient[1], (Vec3{0.0, -1.0, 0.0}));
  EXPECT_EQ(c.scene.body("plate").keyframes.size(), 2U);
  EXPECT_EQ(c.scene.body("plate").shape.kind, Shape::Kind::difference);
  EXPECT_EQ(c.scene.body("drop").temperature->kind, TemperatureField::Kind::expression);
  EXPECT_EQ(c.scene.body("beam").joined_to, (std::vector<std::string>{"plate"}));
  ASSERT_EQ(c.scene.events.size(), 6U);
  EXPECT_EQ(c.scene.events[5].kind, Event::Kind::grip);
  EXPECT_EQ(*c.scene.inflows.at(0).rate, 2e-3 / 60.0);
  EXPECT_EQ(c.engines.at(0).presets, (std::vector<std::string>{"default", "impact"}));
  EXPECT_EQ(std::get<double>(c.engines.at(1).settings.at("walkers")), 1000.0);
  EXPECT_EQ(c.metrics.at(1).reference->kind, ReferenceKind::bound);
  EXPECT_EQ(c.studies.at(0).levels, (std::vector<double>{0.1, 0.05, 0.025}));
  EXPECT_EQ((*c.gates.at(1).band)[1], 2.2);
  EXPECT_EQ(c.defects.at(0).killed_by, (std::vector<std::string>{"error"}));
  EXPECT_EQ(c.harmless, (std::vector<std::string>{"order"}));
}

TEST(ReadCase, PressureIsClampedWhereItsTermIsCorrectedAndWhereverTheCaseSaysSo) {
  const auto clamps = [](const std::string& scene) {
    return read_text(six_lines, {scene}).value.scene.clamps();
  };
  EXPECT_TRUE(clamps("scene.mode=\"corrected\""));
  EXPECT_FALSE(clamps("scene.mode=\"paper\"")) << "the paper prints none";
  EXPECT_FALSE(clamps("scene.clamp=false"));
  const Scene printed = read_text(six_lines, {"scene.mode=\"paper\"", "scene.clamp=true"}).value.scene;
  EXPECT_TRUE(printed.clamps());
  EXPECT_EQ(printed.support_ratio, 2.12) << "a clamp has no kernel";
  RunChoice paper;
  paper.mode = Mode::paper;
  EXPECT_TRUE(scene_for(read_text(six_lines, {"scene.clamp=true"}).value, paper).clamps());
  EXPECT_FALSE(scene_for(read_text(six_lines).value, paper).clamps());
  EXPECT_THROW((void)read_text(six_lines, {"scene.clamp=true", "scene.modes.clamp=paper"}), InputError);
}

TEST(ReadCase, NamesFileLineColumnAndTheNearestKey) {
  expect_refused("[scene]\nend_tme = 1.0\n",
                 {"case.toml:2:1: unknown key `end_tme`", "did you mean `end_time`"});
  expect_refused("[scene]\nend_time = 1.0\ngravty = [0,0,0]\n", {"case.toml:3:1", "`gravity`"});
  expect_refused("[scne]\nend_time = 1.0\n", {"case.toml:1:", "did you mean `scene`"});
  expect_refused(six_lines + "phse = \"rigid\"\n", {"case.toml:7:1", "`phase`"});
  expect_refused(six_lines + "[scene.modes]\nheet = \"paper\"\n", {"case.toml:8:1", "did you mean `heat`"});
}

TEST(ReadCase, RefusesWhatIsNoNumberOrOutOfRangeSayingWhy) {
  expect_refused("[scene]\nend_time = nan\n", {"case.toml:2:12", "finite number"});
  expect_refused("[scene]\nend_time = inf\n", {"case.toml:2:12", "finite number"});
  expect_refused("[scene]\nend_time = -1.0\n", {"greater than 0"});
  expect_refused("[scene]\nend_time = \"3 kg\"\n",
                 {"case.toml:2:12", "in kg, but a number in s is expected"});
  expect_refused("[[material]]\nname='a'\ndensity=-1\n", {"case.toml:3:9", "greater than 0"});
  expect_refused("[[material]]\nname='a'\ndensity=1000\nyoung_modulus=1e6\npoisson_ratio=0.5\n",
                 {"case.toml:5:15", "stiffness infinite"});
  expect_refused("[scene]\nend_time = true\n", {"must be number in s, not true or false"});
  expect_refused(six_lines + "velocity = [1, 2]\n", {"2 components", "[x, y, z]"});
  expect_refused(six_lines + "motion = \"fxed\"\n",
                 {"none of: free, fixed, prescribed", "did you mean `fixed`"});
}

TEST(ReadCase, RefusesNamesThatReferToNothing) {
  expect_refused(
      "[scene]\nend_time=1\n[[body]]\nname='b'\nmaterial='steal'\nshape={kind='sphere',centre=[0,0,0],radius="
      "1}\n",
      {"case.toml:5:10", "did you mean `steel`"});
  expect_refused(six_lines + "joined_to = [\"blok\"]\n", {"case.toml:7", "did you mean `block`"});
  const std::string metric = six_lines + "[[metric]]\nname='speed'\nquantity='velocity'\n";
  EXPECT_EQ(refusal(metric), "");
  expect_refused(metric + "[[gate]]\nmetric='sped'\nlimit=1\nreason='r'\n",
                 {"case.toml:11:8", "no [[metric]] is named \"sped\"", "did you mean `speed`"});
  EXPECT_EQ(refusal(metric + "[[gate]]\nmetric='speed.statistical'\nlimit=1\nreason='r'\n"), "");
  expect_refused(metric + "[[gate]]\nmetric='sped.statistical'\nlimit=1\nreason='r'\n",
                 {"case.toml:11:8", "no [[metric]] is named"});
  expect_refused(metric + "[[gate]]\nmetric='speed'\nreason='r'\n",
                 {"case.toml:10", "no limit and would pass anything"});
  expect_refused(metric + "[[gate]]\nmetric='speed'\nlimit=1\n", {"lacks the key `reason`"});
  expect_refused(metric + "[[gate]]\nmetric='speed.order'\nlimit=1\nreason='r'\n", {"needs a [[study]]"});
  expect_refused(metric + "[[gate]]\nmetric='speed'\nlimit=1\nlevel=0.1\nreason='r'\n",
                 {"no [[study]] has this level"});
  expect_refused(metric + "[[gate]]\nmetric='speed'\nlimit=1\nmode='paper'\nreason='r'\n",
                 {"does not run mode \"paper\""});
  expect_refused(metric + "[engines.bullet]\n[[gate]]\nmetric='speed'\nlimit=1\nengine='bulet'\nreason='r'\n",
                 {"did you mean `bullet`"});
  expect_refused(
      six_lines + "[[body]]\nname='block'\nmaterial='steel'\nshape={kind='sphere',centre=[9,0,0],radius=1}\n",
      {"two tables [[body]] are named \"block\""});
}

TEST(ReadCase, RefusesWhatCannotBeMeant) {
  expect_refused(
      six_lines +
          "temperature = \"20 degC\"\ntemperature_held = true\nmotion = \"fixed\"\nvelocity = [1,0,0]\n",
      {"a fixed body does not move"});
  expect_refused(six_lines + "keyframes = [{time = 0, position = [0,0,0]}]\n",
                 {"only a prescribed body follows keyframes"});
  expect_refused(six_lines + "temperature = -3.0\n", {"case.toml:7", "greater than 0"});
  expect_refused(
      "[scene]\nend_time=1\nperiodic=['x']\n[[body]]\nname='b'\nmaterial='steel'\nshape={kind='sphere',"
      "centre=[0,0,0],radius=1}"
      "\n",
      {"case.toml:3", "give scene.min and scene.max"});
  expect_refused(
      "[scene]\nend_time=1\n[[body]]\nname='b'\nmaterial='steel'\nshape={kind='box',min=[0,0,0],max=[1,0,1]}"
      "\n",
      {"no extent along y"});
  expect_refused("[scene]\nend_time=1\n[[material]]\nname='m'\ndensity=1\nt_melt=300\nt_solid=310\n",
                 {"above t_melt"});
  expect_refused(
      "[scene]\nend_time=1\n[[material]]\nname='m'\ndensity=1\n[[body]]\nname='b'\nmaterial='m'\ntemperature="
      "300\nshape={kind='"
      "sphere',centre=[0,0,0],radius=1}\n",
      {"lacks conductivity"});
}

TEST(ReadCase, RefusesAWordThatTheJudgeDoesNotKnow) {
  const std::string metric = six_lines + "[[metric]]\nname='way'\nquantity='position'\n";
  expect_refused(metric + "norm='L3'\n",
                 {"case.toml:10", "metric.way.norm", "\"L3\" is none of: L1, L2, L2raw, Linf"});
  expect_refused(metric + "[[study]]\naxis='space'\nlevels=[2,1]\n",
                 {"case.toml:11", "study.1.axis", "\"space\" is none of"});
  expect_refused(
      metric + "[[study]]\naxis='spacing'\nlevels=[2,1]\nmode='printed'\n",
      {"case.toml:13", "study.1.mode", "unknown mode \"printed\": write corrected, paper or \"not paper\""});
  expect_refused(metric + "[[gate]]\nmetric='way'\nlimit=1\nreason='r'\nmode='not printed'\n",
                 {"case.toml:14", "gate.1.mode", "unknown mode \"not printed\""});
  const auto r = read_text(
      metric + "norm='L2'\n[[study]]\naxis='spacing'\nlevels=[2,1]\ntime_steps=[2,1]\nmode='not paper'\n");
  EXPECT_EQ(r.value.metrics.at(0).norm, Norm::L2);
  EXPECT_EQ(r.value.studies.at(0).mode, JudgedMode::not_paper);
  EXPECT_EQ(to_string(r.value.studies[0].axes), "spacing+time_step");
}

TEST(ReadCase, TheJudgesWordsForModesAreThoseOfTheScene) {
  for (const Mode mode : {Mode::corrected, Mode::paper})
    EXPECT_TRUE(find_word<JudgedMode>(to_string(mode))) << to_string(mode);
  for (const Axis axis : all_of<Axis>())
    for (const bool both : {false, true}) {
      const StudyAxes axes{axis, both, !both};
      EXPECT_EQ(study_axes_from(to_string(axes)), axes) << to_string(axes);
    }
}

TEST(ReadCase, RefusesATruthThatIsNoFormulaAndATableWithoutAFile) {
  const std::string metric = six_lines + "[[metric]]\nname='speed'\nquantity='velocity_at'\n";
  EXPECT_EQ(refusal(metric + "reference={function='expression',args={value='3*t',axis='x',point=[0,0,0]}}\n"),
            "");
  expect_refused(metric + "reference={function='expression',args={value='3*tt',axis='x'}}\n",
                 {"case.toml:10", "column 3 of the expression", "`tt` is unknown"});
  expect_refused(metric + "reference={function='table'}\n", {"case.toml:10", "needs the key `file`"});
  expect_refused(metric + "reference={function='table',file='no.csv'}\n",
                 {"case.toml:10", "no file `no.csv` beside the case"});
}

TEST(ReadCase, RefusesPhasesThatCannotDiffer) {
  const std::string melts =
      "[scene]\nend_time=1\n[[material]]\nname='m'\ndensity=1\nconductivity=1\nheat_capacity=1000\n";
  const std::string body =
      "[[body]]\nname='b'\nmaterial='m'\nphase='rigid'\ntemperature=280\nshape={kind='sphere',centre=[0,0,0],"
      "radius=1}\n";
  EXPECT_EQ(
      refusal(melts + "t_melt=300\nlatent_heat=1000\nsolid_conductivity=2\nsolid_heat_capacity=500\n" + body),
      "");
  expect_refused(melts + "solid_conductivity=2\n" + body,
                 {"case.toml:8", "without t_melt the material has one phase"});
  expect_refused(
      "[scene]\nend_time=1\n[[material]]\nname='m'\ndensity=1\nt_melt=300\nsolid_heat_capacity=2\n",
      {"case.toml:7", "heat_capacity is missing"});
  expect_refused(melts + "t_melt=300\nt_solid=290\nlatent_heat=1000\nsolid_heat_capacity=500\n" + body,
                 {"case.toml:11", "would take up heat, 4000 J/kg"});
  const std::string unlike = melts + "t_melt=300\nlatent_heat=1000\nsolid_conductivity=2\n" + body;
  expect_refused("[case]\nmodes=['corrected','paper']\n" + unlike,
                 {"case.toml:12", "heat as printed knows one conductivity", "model.heat"});
  EXPECT_NE(refusal(unlike, {"model.phase='paper'"}).find("model.phase"), std::string::npos);
}

TEST(ReadCase, TakesNoSolidOfTheLibraryBesideAValueOfItsOwn) {
  const std::string ice =
      "[scene]\nend_time=1\n[[material]]\nname='ice'\n%s[[body]]\nname='b'\nmaterial='ice'\nshape={kind='"
      "sphere',centre=[0,0,0],"
      "radius=1}\n";
  const auto with = [&](const std::string& line) {
    auto text = ice;
    return read_text(text.replace(text.find("%s"), 2, line)).value.scene.materials[0];
  };
  EXPECT_EQ(with("").solid_conductivity, 2.14);
  EXPECT_EQ(with("").solid_heat_capacity, 2097.0);
  EXPECT_FALSE(with("conductivity = 2.0\n").solid_conductivity.has_value());
  EXPECT_EQ(with("conductivity = 2.0\n").solid_heat_capacity, 2097.0);
  EXPECT_EQ(with("conductivity = 2.0\nsolid_conductivity = 3.0\n").solid_conductivity, 3.0);
}

TEST(ReadCase, RefusesHalfADomain) {
  expect_refused(
      "[scene]\nend_time=1\nmin=[0,0,0]\n[[body]]\nname='b'\nmaterial='steel'\nshape={kind='sphere',centre=["
      "0,0,0],radius=1}\n",
      {"case.toml:3", "give scene.max too"});
}

TEST(ReadCase, SurvivesFilesThatBreakParsers) {
  std::string key;
  for (int i = 0; i < 200000; ++i) key += "a.";
  expect_refused("v = [,]\n", {"case.toml:1:6", "remove the comma"});
  expect_refused("v=[1,}\n", {"case.toml:1:6", "closes nothing"});
  expect_refused("v={a=1,}\n", {"case.toml:1:8", "remove the comma"});
  expect_refused(key + "b = 1\n", {"case.toml:1:", "dotted key"});
  expect_refused("v = " + std::string(5000, '['), {"case.toml:1:", "nested"});
  expect_refused("v = " + std::string(5000, '{'), {"case.toml:1:", "nested"});
  expect_refused(std::string(17000, 'a') + " = 1\n", {"case.toml:1:", "longer than"});
  expect_refused(std::string((1 << 20) + 1, '\n'), {"case.toml", "at most 1048576"});
  expect_refused("", {"case.toml", "empty"});
  expect_refused(std::string("\0\1\2", 3), {"case.toml:1:1", "plain UTF-8 text"});
  expect_refused("[scene\n", {"case.toml:2:1", "close it"});
  expect_refused("a = \"abc\n", {"case.toml:1:", "not closed"});
  expect_refused("a = '''abc\n", {"not closed"});
  expect_refused("[scene]\nend_time=1\nend_time=2\n", {"case.toml:3:", "redefine"});
  expect_refused("\xff\xfe = 1\n", {"case.toml"});
  expect_refused("a = 1979-05-27T07:32:00Z\n", {"case.toml:1:"});
  EXPECT_THROW(static_cast<void>(read_case("/nonexistent/case.toml")), InputError);
  EXPECT_THROW(static_cast<void>(read_case("/")), InputError);
  EXPECT_THROW(static_cast<void>(read_case("/dev/zero")), InputError);
}

TEST(Overrides, ReplaceAnyKeyByTheSameChecks) {
  const auto r = read_text(
      six_lines, {"scene.spacing=0.1", "body.block.velocity=[1, 2, 3]", "material.steel.density=8000",
                  "scene.gravity=[0,0,-9.81]", "model.heat='paper'"});
  EXPECT_EQ(r.value.scene.spacing, 0.1);
  EXPECT_EQ(r.value.scene.bodies[0].velocity.value, (Vec3{1, 2, 3}));
  EXPECT_EQ(r.value.scene.material("steel").density, 8000.0);
  EXPECT_EQ(r.value.scene.modes_given.at(term::heat), Mode::paper);
  EXPECT_TRUE(decision(r, "scene.spacing")->given);
  EXPECT_EQ(decision(r, "scene.spacing")->place.file, "--set scene.spacing=0.1");
  EXPECT_EQ(read_text(six_lines, {"scene.mode=paper"}).value.scene.mode, Mode::paper)
      << "the shell eats quotes";
  EXPECT_EQ(read_text(six_lines, {"scene.spacing=2 cm"}).value.scene.spacing, 0.02);
  EXPECT_EQ(read_text(full_case, {"study.1.levels=[0.1, 0.05]"}).value.studies[0].levels.size(), 2U);
}

TEST(Overrides, RefuseWhatTheyCannotPlace) {
  const auto refused = [](const std::string& set) {
    try {
      static_cast<void>(read_text(six_lines, {set}));
      return std::string();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_NE(refused("scene.spcing=0.1").find("did you mean `spacing`"), std::string::npos);
  EXPECT_NE(refused("body.blok.velocity=[1,2,3]").find("did you mean `block`"), std::string::npos);
  EXPECT_NE(refused("scene.end_time=nan").find("finite"), std::string::npos);
  EXPECT_NE(refused("scene.end_time=-1").find("greater than 0"), std::string::npos);
  for (const char* set :
       {"", "=", "scene.spacing", "scene.spacing=", "=1", "scene.spacing=[1,}", "scene.spacing=1\nx=2",
        "scene..spacing=1", "a.b.c.d.e.f.g.h.i=1", "scene.end_time.x=1", "gate.1.limit=3"})
    EXPECT_NE(refused(set), "") << set;
}

TEST(Library, GivesSourcesAndYieldsToTheCase) {
  const auto r = read_text(
      "[scene]\nend_time=1\n[[material]]\nname='water'\ndensity=1025\n[[body]]\nname='b'\nmaterial='water'"
      "\nshape={kind='sphere',"
      "centre=[0,0,0],radius=1}\n");
  EXPECT_EQ(r.value.scene.material("water").density, 1025.0);
  EXPECT_DOUBLE_EQ(r.value.scene.material("water").viscosity, 1.0016e-3);
  EXPECT_TRUE(decision(r, "material.water.density")->given);
  EXPECT_NE(decision(r, "material.water.viscosity")->reason.find("IAPWS"), std::string::npos);
  EXPECT_EQ(r.value.scene.bodies[0].phase, Phase::liquid);
  for (const char* name : {"water", "ice", "wax", "steel", "rubber"}) {
    const auto one = read_text(six_lines, {std::string("body.block.material='") + name + "'"});
    EXPECT_EQ(one.value.scene.materials[0].name, name);
    EXPECT_NE(decision(one, std::string("material.") + name + ".source")->value, "none");
  }
}

TEST(SceneFor, WhatFreezesJoinsAllThatItsBondsReachWherePhaseIsPrintedAndNearestNeighboursElse) {
  RunChoice paper;
  paper.mode = Mode::paper;
  const auto c = read_text(six_lines).value;
  EXPECT_EQ(scene_for(c, {}).merge_distance, 1.5);
  EXPECT_EQ(scene_for(c, paper).merge_distance, 2.12);
  const auto printed = read_text(six_lines, {"model.phase=paper"});
  EXPECT_EQ(printed.value.scene.merge_distance, 2.12);
  EXPECT_FALSE(decision(printed, "scene.merge_distance")->given);
  EXPECT_EQ(scene_for(read_text(six_lines, {"scene.merge_distance=1.2"}).value, paper).merge_distance, 1.2)
      << "what the case says stays";
}

TEST(SceneFor, ResolvesModesAndSupportRatioForEachRun) {
  const auto c = read_text(six_lines, {"model.heat=paper"}).value;
  RunChoice paper;
  paper.mode = Mode::paper;
  paper.spacing = 0.1;
  paper.time_step = 1e-4;
  paper.seed = 7;
  paper.jitter = 0.1;
  const auto s = scene_for(c, paper);
  EXPECT_EQ(s.support_ratio, 2.12) << "every term is paper";
  EXPECT_EQ(s.spacing, 0.1);
  EXPECT_EQ(*s.time_step, 1e-4);
  EXPECT_EQ(s.seed, 7U);
  EXPECT_EQ(scene_for(c, {}).support_ratio, 2.6);
  EXPECT_EQ(scene_for(c, {}).mode_of(term::heat), Mode::paper) << "a term that the case fixes stays";
  EXPECT_EQ(scene_for(read_text(six_lines, {"scene.support_ratio=3"}).value, paper).support_ratio, 3.0);
}

/// What the transport velocity moves is refused where it clamps.
TEST(Ablation, KeepsTheClampOfACaseWhoseParticlesMoveByTheTransportVelocity) {
  for (const bool moves : {true, false}) {
    auto c = read_text(six_lines, {"model.clamp=paper", "model.time=paper"}).value;
    c.scene.transport_velocity = moves;
    const Scene s = scene_for(corrected(c), {});
    EXPECT_EQ(s.clamps(), !moves);
    EXPECT_EQ(s.mode_of(term::time), Mode::corrected);
  }
}

}  // namespace
}  // namespace tripoint::test
