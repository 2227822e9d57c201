// SPDX-License-Identifier: BSD-3-Clause
// docs/add-an-effect.md, done: an effect that the program does not have, as one folder and one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "assembly/declared_view.hpp"
#include "assembly/plan.hpp"
#include "core/defect.hpp"
#include "effects/drag/terms.hpp"
#include "files/scene_json.hpp"
#include "sampling/sample.hpp"
#include "scene/case_file.hpp"
#include "scene/shared_terms.hpp"
#include "step/simulation.hpp"
#include "tables/expression.hpp"
#include "validation/case/ablation.hpp"
#include "validation/case/read_case.hpp"
#include "validation/case/schema.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

const fs::path root = TRIPOINT_SOURCE_DIR;
const std::string case_file = (root / "tests/effects/drag/slowed-ball.toml").string();

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Case slowed_ball(const std::vector<std::string>& set = {}) { return read_case(case_file, set).value; }

Simulation start(const Case& value) {
  const Scene scene = scene_for(value, {});
  return {scene, sample(scene)};
}

double way_of(const Simulation& s) { return s.state().bodies[field::body_centre][0].x; }

/// Greatest difference between the way of the ball and the formula that the case states [m].
double error_of(const Case& value) {
  const Expression truth(std::get<std::string>(value.reference.args.at("value")), Expression::Time::known);
  Simulation s = start(value);
  const double from = way_of(s);
  double worst = 0.0;
  for (int n = 1; n <= 20; ++n) {
    const double time = value.scene.end_time * n / 20.0;
    s.advance_to(time);
    worst = std::max(worst, std::abs(way_of(s) - from - truth({}, time)));
  }
  return worst;
}

TEST(AddedEffect, IsCalledForByItsKeyAndLeftOutForAReason) {
  const Plan with = plan(scene_for(slowed_ball(), {})),
             without = plan(scene_for(slowed_ball({"material.ball.drag=0"}), {}));
  const auto on = std::ranges::find(with.effects, "drag", &PlannedEffect::name);
  ASSERT_NE(on, with.effects.end());
  EXPECT_EQ(on->why, "body ball: it moves through a gas that brakes it");
  EXPECT_NE(std::ranges::find(with.fields, "drag_force.x", &PlannedField::name), with.fields.end());
  const auto idle = std::ranges::find(without.idle, "drag", &PlannedEffect::name);
  ASSERT_NE(idle, without.idle.end());
  EXPECT_EQ(idle->why, "no material has a drag");
  EXPECT_EQ(std::ranges::find(without.fields, "drag_force.x", &PlannedField::name), without.fields.end());
}

/// The tool that writes the dictionary finds them there (tests/docs/written_test.py).
TEST(AddedEffect, SaysInItsFolderWhatItsFieldsMean) {
  const std::string words = text_of(root / "tests/effects/drag/fields.toml");
  int own = 0;
  for (const PlannedField& field : plan(scene_for(slowed_ball(), {})).fields) {
    if (field.owner != "drag") continue;
    ++own;
    EXPECT_NE(words.find("\n" + field.name.substr(0, field.name.find('.')) + " = {"), std::string::npos)
        << field.name;
  }
  EXPECT_EQ(own, 3);
}

TEST(AddedEffect, BringsItsKeyToTheReaderTheSchemaAndThePage) {
  EXPECT_EQ(value_of(slowed_ball().scene.material("ball").values, "drag"), 2.0);
  EXPECT_EQ(value_of(slowed_ball({"material.ball.drag=\"0.5 1/s\""}).scene.material("ball").values, "drag"),
            0.5);
  try {
    static_cast<void>(slowed_ball({"material.ball.drag=-1"}));
    ADD_FAILURE() << "a negative drag was taken";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("0 or greater"), std::string::npos) << e.what();
  }
  EXPECT_NE(case_reference_page().find("hare of the velocity that drag takes in a second"),
            std::string::npos);
  EXPECT_NE(case_schema().find("\"drag\""), std::string::npos);
}

TEST(AddedEffect, PassesItsValueOnToEveryEngine) {
  const Scene sent = scene_for(slowed_ball(), {});
  Scene received;
  std::vector<JobBody> bodies(sent.bodies.size());
  scene_from_json(scene_to_json(sent, bodies), received, bodies);
  EXPECT_EQ(value_of(received.materials.at(0).values, "drag"), 2.0);
}

/// Words of [modes], in the order of jobs.
std::vector<std::string> words_of_modes(const Scene& scene) {
  const std::vector<JobBody> bodies(scene.bodies.size());
  const nlohmann::ordered_json job = scene_to_json(scene, bodies);
  std::vector<std::string> words;
  for (const auto& [word, form] : job["modes"].items()) words.push_back(word);
  return words;
}

TEST(AddedEffect, BringsItsTermToTheReaderTheJobTheSchemaAndThePage) {
  EXPECT_EQ(scene_for(slowed_ball(), {}).mode_of(term::drag), Mode::corrected);
  const CaseReading reading = read_case(case_file, {"scene.modes.drag=\"paper\""});
  EXPECT_EQ(scene_for(reading.value, {}).mode_of(term::drag), Mode::paper);
  EXPECT_TRUE(std::ranges::any_of(reading.decisions,
                                  [](const Decision& d) { return d.key == "scene.modes.drag" && d.given; }));
  RunChoice paper;
  paper.mode = Mode::paper;
  EXPECT_EQ(scene_for(slowed_ball(), paper).mode_of(term::drag), Mode::paper);

  Scene received;
  std::vector<JobBody> bodies(1);
  scene_from_json(scene_to_json(scene_for(reading.value, {}), bodies), received, bodies);
  EXPECT_EQ(received.mode_of(term::drag), Mode::paper);
  const std::vector<std::string> order{"kernel",    "pressure", "density",  "state",     "clamp",
                                       "viscosity", "walls",    "elastic",  "hourglass", "heat",
                                       "phase",     "drag",     "rotation", "time"};
  EXPECT_EQ(words_of_modes(received), order)
      << "those of the program stay in the order that jobs have had from the start";

  EXPECT_NE(case_reference_page().find("\n- `drag`: word"), std::string::npos);
  const auto schema = nlohmann::json::parse(case_schema());
  EXPECT_TRUE(schema["$defs"]["modes"]["properties"].contains("drag"));
}

TEST(AddedEffect, HasAWordOfModesThatIsSuggestedWhereItIsMisspelt) {
  const test::Folder folder;
  std::string text = text_of(case_file);
  text.insert(text.find("[[material]]"), "[scene.modes]\ndrga = \"paper\"\n\n");
  const auto line = std::ranges::count(text.substr(0, text.find("drga")), '\n') + 1;
  try {
    static_cast<void>(read_case(folder.write("case.toml", text)));
    ADD_FAILURE() << "an unknown term was taken";
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("case.toml:" + std::to_string(line) + ":"), std::string::npos) << what;
    EXPECT_NE(what.find("`drga` is no term of the model (did you mean `drag`?)"), std::string::npos) << what;
  }
}

TEST(AddedEffect, HasItsRowOfAblationWhereItActs) {
  const std::vector<Correction> all = corrections();
  const auto row = std::ranges::find(all, "drag", &Correction::name);
  ASSERT_NE(row, all.end());
  ASSERT_TRUE(row->of->term);
  const Case value = corrected(slowed_ball());
  EXPECT_TRUE(can_act(*row, value.scene));
  EXPECT_FALSE(can_act(*row, slowed_ball({"material.ball.drag=0"}).scene));
  const Case as_printed = without(*row, value);
  EXPECT_EQ(scene_for(as_printed, {}).mode_of(term::drag), Mode::paper);
  EXPECT_EQ(scene_for(as_printed, {}).mode_of(term::time), Mode::corrected) << "all others stay";
  EXPECT_GT(error_of(as_printed), 10.0 * *slowed_ball().gates.at(0).limit)
      << "which is what the correction buys";
}

TEST(AddedEffect, RefusesATermThatNobodyHasDeclared) {
  EXPECT_THROW(static_cast<void>(Scene().mode_of(Term{"lift"})), UndeclaredTerm);
  EXPECT_THROW(static_cast<void>(scene_for(slowed_ball(), {}).mode_of(Term{"lift"})), UndeclaredTerm);
}

TEST(AddedEffect, IsRefusedAColumnThatItHasNotDeclared) {
  const Scene scene = scene_for(slowed_ball(), {});
  const Simulation s(scene, sample(scene));
  const std::vector<Active> effects = active_effects(scene);
  const Active& drag = *std::ranges::find(effects, "drag", &Active::name);
  const Particles& p = s.state().particles;
  {
    const DeclaredView view(s.state(), drag);
    EXPECT_EQ(p[field::velocity.x].size(), p.size());
    try {
      static_cast<void>(p[field::position.x]);
      ADD_FAILURE() << "a place was given out";
    } catch (const UndeclaredField& e) {
      EXPECT_STREQ(e.what(),
                   "the effect drag asks for the field position.x, which its `owns` and `reads` do not name");
    }
  }
  EXPECT_EQ(p[field::position.x].size(), p.size());  // those who are no effect see all
}

TEST(AddedEffect, SlowsTheBallAsItsCaseSays) {
  const Case value = slowed_ball();
  EXPECT_LT(error_of(value), *value.gates.at(0).limit);
}

TEST(AddedEffect, HasADefectThatItsCaseKills) {
  const Case value = slowed_ball();
  const Defect& defect = value.defects.at(0);
  const auto known = registered_defects();
  EXPECT_NE(std::ranges::find(known, defect.name, &DefectEntry::name), known.end());
  const std::string broken = defect.name + "=" + std::to_string(defect.size);
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own: a defect is looked up once in each
  EXPECT_EXIT(
      {
        setenv("TRIPOINT_DEFECT", broken.c_str(), 1);
        std::exit(error_of(value) > *value.gates.at(0).limit ? 3 : 0);
      },
      testing::ExitedWithCode(3), "");
}

TEST(AddedEffect, AccumulatesItsWorkSoThatTheLedgerCloses) {
  Simulation s = start(slowed_ball());
  const double before = s.ledger().energy.at("kinetic");
  s.advance_to(1.0);
  const Ledger after = s.ledger();
  double sum = 0.0;
  for (const auto& [entry, energy] : after.energy) sum += energy;
  EXPECT_NEAR(sum / before, 1.0, 1e-13);                                      // round-off of 100 steps
  EXPECT_NEAR(after.energy.at("drag") / before, 1.0 - std::exp(-4.0), 1e-4);  // second order in the step
  const std::vector<LedgerEntry> known = ledger_entries();
  for (const auto& [entry, energy] : after.energy)
    EXPECT_NE(std::ranges::find(known, entry, &LedgerEntry::name), known.end())
        << entry << " stands in no rule";
}

TEST(AddedEffect, IsPaidByWhoDrivesABody) {
  Simulation s = start(slowed_ball({"body.ball.motion=\"prescribed\""}));
  s.advance_to(1.0);
  const std::map<std::string, double> energy = s.ledger().energy;
  const double m = s.ledger().mass;
  // c m v^2 t; the force is that of 1/(1 + c dt/2) of the velocity
  EXPECT_NEAR(energy.at("drag"), 2.0 * m, 0.02 * m);
  EXPECT_NEAR(energy.at("walls"), -energy.at("drag"), 1e-12 * m);
}

/// A drag that drives the ball is stopped by the guard of energy, which takes the entry as the effect says.
TEST(AddedEffect, IsStoppedWhereItsForceMakesEnergy) {
  const Case value = slowed_ball({"scene.time_step=0.001"});
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("TRIPOINT_DEFECT", "drag.force=3", 1);
        try {
          static_cast<void>(error_of(value));
        } catch (const Diverged& stopped) {
          std::exit(std::string(stopped.what()).find("drag, which may only take energy") != std::string::npos
                        ? 3
                        : 4);
        }
      },
      testing::ExitedWithCode(3), "");
}

TEST(AddedEffect, BoundsTheStep) {
  const Simulation s = start(slowed_ball({"scene.time_step=\"auto\""}));
  EXPECT_EQ(s.bound().name, "drag");
  EXPECT_DOUBLE_EQ(s.bound().dt, 0.5);
}

TEST(AddedEffect, GoesOnWithTheSameBitsAfterARestart) {
  const Scene scene = scene_for(slowed_ball(), {});
  const InitialState initial = sample(scene);
  Simulation whole(scene, initial), cut(scene, initial);
  cut.advance_to(0.5);
  Simulation resumed(scene, initial, {}, cut.checkpoint());
  whole.advance_to(0.5);
  whole.advance_to(1.0);
  resumed.advance_to(1.0);
  EXPECT_EQ(way_of(whole), way_of(resumed));
  EXPECT_EQ(whole.ledger().energy, resumed.ledger().energy);
}

/// Every block of code of docs/add-an-effect.md stands so in this folder or in an effect of the program.
TEST(AddedEffect, IsShownByThePageAsCodeStands) {
  std::string code;
  for (const fs::path& folder : {root / "tests/effects/drag", root / "src/effects"})
    for (const auto& file : fs::recursive_directory_iterator(folder))
      if (file.is_regular_file()) code += text_of(file.path());
  const std::string page = text_of(root / "docs/add-an-effect.md"), fence = "```cpp\n";
  int blocks = 0;
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const std::string block = page.substr(at, page.find("```", at) - at);
    EXPECT_NE(code.find(block), std::string::npos) << block;
    ++blocks;
  }
  EXPECT_EQ(blocks, 3);
}

/// The page leads to every file of the example; what it says of them is compiled and run by the tests above.
TEST(AddedEffect, IsTheExampleOfThePage) {
  const std::string page = text_of(root / "docs/add-an-effect.md");
  int files = 0;
  for (const auto& file : fs::directory_iterator(root / "tests/effects/drag")) {
    const std::string name = file.path().filename().string();
    if (name == "drag_test.cpp") continue;
    EXPECT_NE(page.find("[" + name + "](../tests/effects/drag/" + name + ")"), std::string::npos)
        << "the page has no link to " << name;
    ++files;
  }
  EXPECT_EQ(files, 7);
}

}  // namespace
}  // namespace tripoint
