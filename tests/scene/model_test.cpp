// SPDX-License-Identifier: BSD-3-Clause
// The table [model]: the form of each term by a word.
#include "scene/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "case_file.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shared_terms.hpp"
#include "validation/case/ablation.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/schema.hpp"

namespace tripoint::test {
namespace {

const ModelTerm& term_named(std::string_view name) {
  const auto at = std::ranges::find(model_terms(), name, &ModelTerm::name);
  if (at == model_terms().end()) throw std::logic_error("no term " + std::string(name));
  return *at;
}

/// A pool beside an elastic block, so that most terms act.
std::string pool(const std::string& keys = "", const std::string& model = "") {
  return "[scene]\nend_time = 1\nspacing = 0.1\ngravity = [0, 0, -9.81]\n" + keys + "\n[model]\n" + model +
         R"(
[[material]]
name = 'ink'
density = 1000
viscosity = 1
sound_speed = 20
[[body]]
name = 'pool'
material = 'ink'
phase = 'liquid'
shape = {kind = 'box', min = [0, 0, 0], max = [0.3, 0.3, 0.3]}
)";
}

std::string word_in(const Scene& scene, std::string_view name) {
  const ModelForm* form = form_in(scene, term_named(name));
  return form ? std::string(form->word) : "";
}

TEST(Model, GivesEachTermEachOfItsFormsByItsWord) {
  for (const ModelTerm& t : model_terms()) {
    if (t.term == term::kernel) continue;  // can only say what mode says
    std::set<std::string_view> words;
    for (const ModelForm& form : t.forms) {
      EXPECT_TRUE(words.insert(form.word).second) << t.name << " has " << form.word << " twice";
      const std::string line = std::string(t.name) + " = '" + std::string(form.word) + "'";
      EXPECT_EQ(word_in(scene_for(read_text(pool("", line)).value, {}), t.name), form.word) << line;
    }
    EXPECT_EQ(t.forms.back().word == "paper", t.term.has_value()) << t.name;
  }
}

TEST(Model, SaysWhatTheKeysOfTheSceneSay) {
  const auto same = [](const std::string& keys, const std::string& model) {
    const Scene by_keys = scene_for(read_text(pool(keys)).value, {}),
                by_words = scene_for(read_text(pool("", model)).value, {});
    for (const ModelTerm& t : model_terms())
      EXPECT_EQ(word_in(by_keys, t.name), word_in(by_words, t.name)) << t.name << ": " << model;
    EXPECT_EQ(by_keys.values, by_words.values) << model;
    EXPECT_EQ(by_keys.modes, by_words.modes) << model;
    EXPECT_EQ(by_keys.viscosity_form, by_words.viscosity_form) << model;
  };
  same("viscosity_form = 'laplacian'", "viscosity = 'morris'");
  same("isotropic_shear = 1", "viscosity = 'isotropic'");
  same("modes.viscosity = 'paper'", "viscosity = 'paper'");
  same("clamp = false", "clamp = 'paper'");
  same("bending = 1", "elasticity = 'second-order'");
  same("contact_stiffness = 24", "contact = 'stiff'");
  same("contact_step = 1", "contact_step = 'at-touch'");
  same("face_pressure = 1", "contact_face = 'face'");
  same("core_reach = 0", "core = 'none'");
  same("surface_weight = 0", "surface = 'none'");
  same("interface_weight = 1", "interface = 'weighted'");
  same("bulk_viscosity = 0", "bulk_viscosity = 'none'");
  same("mean_pressure = 1\nsound_damping = 0.2", "mean_pressure = 'neighbours'\nsound_damping = 'bulk'");
  same("surface_exchange = 0", "heat_surface = 'held'");
  same("bulk_viscosity = 1", "bulk_viscosity = 'thick'");
  same("contact_step = 0.3", "contact_step = 'short-at-touch'");
  same("clamp = false\ntransport_velocity = true", "clamp = 'paper'\ntransport = 'background'");
  same("hourglass = 1", "hourglass = 'energy'");
}

TEST(Model, HoldsInEveryMode) {
  const Case value = read_text(pool("mode = 'paper'", "viscosity = 'morris'")).value;
  EXPECT_EQ(word_in(scene_for(value, {}), "viscosity"), "morris");
  EXPECT_EQ(word_in(scene_for(value, {}), "pressure"), "paper");
}

TEST(Model, IsFilledByModeAndExplained) {
  const auto reading = read_text(pool("mode = 'paper'", "viscosity = 'morris'"));
  const Decision* pressure = decision(reading, "model.pressure");
  ASSERT_TRUE(pressure);
  EXPECT_EQ(pressure->value, "\"paper\"");
  const Decision* viscosity = decision(reading, "model.viscosity");
  ASSERT_TRUE(viscosity);
  EXPECT_TRUE(viscosity->given);
  EXPECT_EQ(decision(reading, "scene.viscosity_form"), nullptr) << "an old key that is not given";
  const Decision* core = decision(reading, "model.core");
  ASSERT_TRUE(core);
  EXPECT_EQ(core->value, "\"repulsive\"");
  EXPECT_EQ(core->reason, "keeps pairs apart where the clamp leaves no pressure");
}

TEST(Model, SaysTheClampInEveryModeAsThePaperPrintsNone) {
  const Case both =
      read_text("[case]\nmodes = ['corrected', 'paper']\n" + pool("", "clamp = 'clamped'")).value;
  for (const Mode mode : {Mode::corrected, Mode::paper}) {
    RunChoice run;
    run.mode = mode;
    EXPECT_TRUE(scene_for(both, run).clamps()) << to_string(mode);
  }
}

TEST(Model, RefusesAFormThatIsGivenTwiceAndAWordThatIsNone) {
  expect_refused(pool("modes.viscosity = 'paper'", "viscosity = 'morris'"),
                 {"model.viscosity", "scene.modes.viscosity"});
  expect_refused(pool("clamp = true", "clamp = 'paper'"), {"model.clamp", "scene.clamp"});
  expect_refused(pool("viscosity_form = 'central'", "viscosity = 'morris'"),
                 {"model.viscosity", "scene.viscosity_form"});
  expect_refused(pool("core_reach = 0", "core = 'none'"), {"model.core", "scene.core_reach"});
  expect_refused(pool("", "viscosity = 'moris'"), {"case.toml:", "model.viscosity", "morris"});
  expect_refused(pool("", "viscositi = 'morris'"), {"viscositi", "viscosity"});
}

TEST(Model, NotesEachOldKeyThatAWordSays) {
  const auto notes = [](const std::string& keys) {
    std::string all;
    for (const Finding& f : old_keys(read_text(pool(keys)))) all += f.what + "\n";
    return all;
  };
  EXPECT_EQ(notes("core_reach = 0\nisotropic_shear = 1"),
            "scene.core_reach = 0 is now model.core = \"none\"\n"
            "scene.isotropic_shear = 1 is now model.viscosity = \"isotropic\"\n");
  EXPECT_EQ(notes("clamp = false"), "scene.clamp = false is now model.clamp = \"paper\"\n");
  EXPECT_EQ(notes("modes.heat = 'paper'"), "scene.modes.heat = \"paper\" is now model.heat = \"paper\"\n");
  EXPECT_EQ(notes("transport_velocity = true\nclamp = false"),
            "scene.clamp = false is now model.clamp = \"paper\"\n"
            "scene.transport_velocity = true is now model.transport = \"background\"\n");
  EXPECT_EQ(notes("bulk_viscosity = 0.7"),
            "scene.bulk_viscosity = 0.7 acts, and no word of model.bulk_viscosity says it: numerical, thick, "
            "none\n");
  EXPECT_EQ(notes("bond_reach = 2.5"), "scene.bond_reach = 2.5 acts, and no word of [model] says it\n");
  EXPECT_EQ(notes("contact_viscosity = 1"), "") << "a property, and no form of a term";
}

TEST(Model, TakesThePlaceOfWhatAnOldKeySaysInTheBaseAndTheOtherWayRound) {
  const auto word = [](const std::string& base, const std::string& set, const char* name) {
    return word_in(scene_for(read_text(base, {set}).value, {}), name);
  };
  EXPECT_EQ(word(pool("", "viscosity = 'morris'"), "scene.viscosity_form=central", "viscosity"), "central");
  EXPECT_EQ(word(pool("viscosity_form = 'laplacian'"), "model.viscosity=isotropic", "viscosity"),
            "isotropic");
  EXPECT_EQ(word(pool("", "clamp = 'paper'"), "scene.clamp=true", "clamp"), "clamped");
  EXPECT_EQ(word(pool("", "heat = 'paper'"), "scene.modes.heat=corrected", "heat"), "conservative");
  EXPECT_EQ(word(pool("modes.heat = 'paper'"), "model.heat=conservative", "heat"), "conservative");
}

TEST(Model, HasNoOldKeyOnThePageNorInSuggestions) {
  for (const ModelTerm& t : model_terms())
    for (const std::string& key : old_keys_of(t))
      if (scene_keys().has("scene", key)) {
        EXPECT_TRUE(key_row("scene", key).old) << key;
        EXPECT_EQ(case_reference_page().find("- `" + key + "`: number"), std::string::npos) << key;
      }
  EXPECT_EQ(refusal(pool("core_reech = 0")).find("core_reach"), std::string::npos);
}

TEST(Model, PutsATermBackToItsLastAndItsUsualForm) {
  const Case plain = corrected(read_text(pool("", "pressure = 'conservative'")).value),
             isotropic =
                 corrected(read_text(pool("", "pressure = 'conservative'\nviscosity = 'isotropic'")).value);
  const auto rows = [](const Case& value) {
    std::set<std::string> names;
    for (const Correction& one : corrections())
      if (can_act(one, scene_for(value, {}))) names.insert(one.name);
    return names;
  };
  EXPECT_TRUE(rows(plain).contains("viscosity"));
  EXPECT_FALSE(rows(plain).contains("viscosity=central"));
  EXPECT_TRUE(rows(isotropic).contains("viscosity=central"));
  EXPECT_TRUE(rows(plain).contains("core"));
  EXPECT_FALSE(rows(plain).contains("contact")) << "no solid is there";
  for (const Correction& one : corrections()) {
    if (!can_act(one, scene_for(isotropic, {}))) continue;
    EXPECT_EQ(form_in(scene_for(without(one, isotropic), {}), *one.of), one.form) << one.name;
  }
}

}  // namespace
}  // namespace tripoint::test
