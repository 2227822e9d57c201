// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case_file.hpp"
#include "validation/case/case_document.hpp"

/// What a case says by another, and where it says that wrongly.
namespace tripoint::test {
namespace {

namespace fs = std::filesystem;

const std::string base_text = R"(format = 1
[case]
id = "test/base"
title = "A block"
profiles = ["nightly"]
tags = ["rigid"]
[scene]
end_time = 1.0
spacing = 0.1
jitter = 0.1
[[body]]
name = "block"
material = "steel"
shape = { kind = "box", min = [0, 0, 0], max = [0.4, 0.4, 0.4] }
velocity = [1, 0, 0]
[[body]]
name = "lid"
material = "ice"
phase = "rigid"
shape = { kind = "box", min = [0, 0, 0.4], max = [0.4, 0.4, 0.8] }
[engines.tripoint]
required = true
[engines.bullet]
preset = ["default", "impact"]
[reference]
function = "stated"
kind = "bound"
args = { value = 1.0 }
[[metric]]
name = "place"
quantity = "position"
body = "block"
unit = "m"
[[metric]]
name = "count"
quantity = "body_count"
[[study]]
axis = "time_step"
levels = [0.02, 0.01]
metric = "place"
[[gate]]
metric = "place"
engine = "tripoint"
band = [0.1, 0.2]
reason = "measured"
[[gate]]
metric = "count"
limit = 0.5
reason = "nothing breaks"
)";

class Extends : public ::testing::Test {
 protected:
  CaseReading read(const std::string& text) const { return read_case(folder_.write("case.toml", text)); }
  CaseReading variant(const std::string& text, const std::string& base = base_text) const {
    static_cast<void>(folder_.write("base.toml", base));
    return read("extends = \"base.toml\"\n" + text);
  }
  /// The refusal, from the name of the file on.
  std::string refusal_of(const std::string& text, const std::string& base = base_text) const {
    try {
      static_cast<void>(variant(text, base));
      return "";
    } catch (const InputError& e) {
      return fs::path(e.place().file).filename().string() + ":" + std::to_string(e.place().line) + ": " +
             e.what();
    }
  }
  Folder folder_;
};

TEST_F(Extends, TakesFromTheOtherCaseWhatItDoesNotSay) {
  const auto base = read(base_text);
  const auto same = variant("");
  EXPECT_EQ(same.value.scene.bodies.size(), 2U);
  EXPECT_EQ(same.value.gates.size(), 2U);
  EXPECT_EQ(same.value.profiles, std::vector<std::string>{"nightly"});
  EXPECT_NE(same.value.id, base.value.id) << "a name belongs to one file";
}

TEST_F(Extends, MergesTablesKeyByKey) {
  const auto r = variant(
      "[scene]\nend_time = 2.0\n[model]\nheat = \"paper\"\n[engines.bullet]\nrequired = "
      "true\n[case]\ntitle = "
      "\"Another\"\n");
  EXPECT_EQ(r.value.scene.end_time, 2.0);
  EXPECT_EQ(r.value.scene.jitter, 0.1);
  EXPECT_EQ(r.value.title, "Another");
  EXPECT_EQ(r.value.tags, std::vector<std::string>{"rigid"});
  ASSERT_EQ(r.value.engines.size(), 2U);
  EXPECT_TRUE(r.value.engines[1].required);
  EXPECT_EQ(r.value.engines[1].presets.size(), 2U);
}

TEST_F(Extends, ReplacesWholeWhatIsOfAnotherKind) {
  const auto r = variant(
      "[[body]]\nname = \"block\"\nshape = { kind = \"sphere\", centre = [0.2, 0.2, 0.2], radius = 0.2 "
      "}\n[reference]\nkind = "
      "\"invariant\"\n");
  EXPECT_EQ(r.value.scene.bodies[0].shape.kind, Shape::Kind::sphere);
  EXPECT_EQ(r.value.scene.bodies[0].material, "steel");
  EXPECT_TRUE(r.value.reference.function.empty());
  EXPECT_TRUE(r.value.reference.args.empty());
}

TEST_F(Extends, MergesTablesOfAnArrayByName) {
  const auto r = variant(
      "[[body]]\nname = \"third\"\nmaterial = \"steel\"\nshape = { kind = \"sphere\", centre = [3, 0, 0], "
      "radius = 0.2 "
      "}\n[[body]]\nname = \"block\"\nvelocity = [0, 2, 0]\n");
  ASSERT_EQ(r.value.scene.bodies.size(), 3U);
  EXPECT_EQ(r.value.scene.bodies[0].name, "block");
  EXPECT_EQ(r.value.scene.bodies[0].velocity.value.y, 2.0);
  EXPECT_EQ(r.value.scene.bodies[2].name, "third");
}

TEST_F(Extends, MergesGatesByWhatTheyJudgeAndABoundReplacesABound) {
  const auto r = variant(
      "[[metric]]\nname = \"place\"\ngates = [{ engine = \"tripoint\", limit = 0.3 }, { engine = \"bullet\", "
      "limit = 0.4, reason "
      "= \"its own\" }]\n");
  ASSERT_EQ(r.value.gates.size(), 3U);
  EXPECT_EQ(r.value.gates[0].limit, 0.3);
  EXPECT_FALSE(r.value.gates[0].band);
  EXPECT_EQ(r.value.gates[0].reason, "measured");
  EXPECT_EQ(r.value.gates[2].engine, "bullet");
  EXPECT_EQ(r.value.metrics[0].unit, "m");
}

TEST_F(Extends, RemovesWhatDoesNotHold) {
  const auto r =
      variant("remove = [\"scene.jitter\", \"engines.bullet\", \"metric.count\", \"study\", \"body.lid\"]\n");
  EXPECT_EQ(r.value.scene.jitter, 0.0);
  EXPECT_EQ(r.value.engines.size(), 1U);
  EXPECT_EQ(r.value.metrics.size(), 1U);
  EXPECT_EQ(r.value.gates.size(), 1U) << "a gate goes with its metric";
  EXPECT_TRUE(r.value.studies.empty());
  EXPECT_EQ(r.value.scene.bodies.size(), 1U);
  EXPECT_EQ(variant("remove = [\"body.block.velocity\"]\n").value.scene.bodies[0].velocity.value.x, 0.0);
  EXPECT_EQ(variant("remove = [\"gate.place\"]\n").value.gates.size(), 1U);
  EXPECT_TRUE(variant("remove = [\"study\", \"metric\"]\n").value.gates.empty());
  EXPECT_TRUE(variant("remove = [\"study\", \"metric\", \"gate\"]\n").value.gates.empty());
  for (const char* wrong : {"scene.jittr", "engines.lammps", "metric.speed", "study.1", "inflow",
                            "scene.jitter.x", "format.x", ".", "x."})
    EXPECT_NE(refusal_of(std::string("remove = [\n\"") + wrong + "\"]\n").find("case.toml:3: "),
              std::string::npos)
        << wrong;
  EXPECT_NE(refusal("remove = [\"study\"]\n" + base_text).find("extends nothing"), std::string::npos);
}

TEST_F(Extends, NamesTheFileAndTheLineWhereTheWrongKeyStands) {
  EXPECT_EQ(refusal_of("[scene]\nend_tme = 1.0\n").find("case.toml:3: "), 0U);
  EXPECT_EQ(refusal_of("[scene]\nseed = 2\n", base_text + "[[gate]]\nmetrc = \"place\"\n")
                .find("base.toml:" +
                      std::to_string(std::count(base_text.begin(), base_text.end(), '\n') + 2) + ": "),
            0U);
  EXPECT_EQ(refusal_of("[[body]]\nname = \"block\"\nmaterial = \"steal\"\n").find("case.toml:4: "), 0U);
  EXPECT_EQ(refusal_of("[[body]]\nname = \"block\"\nvelocity = [0, 0, 1]\n", "extends = \"none.toml\"\n")
                .find("base.toml:1: "),
            0U);
  const auto r =
      variant("[[metric]]\nname = \"place\"\ngates = [\n{ engine = \"tripoint\", limit = 0.3 },\n]\n");
  EXPECT_EQ(fs::path(r.value.gates[0].place.file).filename(), "case.toml");
  EXPECT_EQ(r.value.gates[0].place.line, 5);
  EXPECT_EQ(fs::path(r.value.gates[1].place.file).filename(), "base.toml");
}

TEST_F(Extends, RefusesWhatMeetsMoreThanOne) {
  const std::string twice =
      base_text + "[[gate]]\nmetric = \"place\"\nengine = \"tripoint\"\nat_least = 0.1\nreason = \"r\"\n";
  EXPECT_NE(refusal_of("[[gate]]\nmetric = \"place\"\nengine = \"tripoint\"\nlimit = 0.1\n", twice)
                .find("more than one such table"),
            std::string::npos);
  EXPECT_NE(
      refusal_of("[[body]]\nname = \"lid\"\n[[body]]\nname = \"lid\"\n").find("more than one such table"),
      std::string::npos);
}

TEST_F(Extends, RefusesACircleByName) {
  static_cast<void>(folder_.write("third.toml", "extends = \"case.toml\"\n"));
  const auto what = refusal_of("", "extends = \"third.toml\"\n");
  EXPECT_NE(what.find("case.toml -> base.toml -> third.toml -> case.toml"), std::string::npos) << what;
  EXPECT_NE(refusal("extends = \"case.toml\"\n").find("circle"), std::string::npos);
}

TEST_F(Extends, FollowsAChainOfEightFilesAndNoLonger) {
  static_cast<void>(folder_.write("1.toml", base_text));
  for (int n = 2; n <= 9; ++n)
    static_cast<void>(folder_.write(
        std::to_string(n) + ".toml",
        "extends = \"" + std::to_string(n - 1) + ".toml\"\n[scene]\nseed = " + std::to_string(n) + "\n"));
  EXPECT_EQ(read_case(folder_.path() + "/8.toml").value.scene.seed, 8U);
  EXPECT_THROW(static_cast<void>(read_case(folder_.path() + "/9.toml")), InputError);
}

/// A third-party case is no way to read the files of the machine, not even one line of them.
TEST_F(Extends, ReadsNoFileThatIsNoCaseBesideIt) {
  fs::create_directories(folder_.path() + "/cases/a/deep.toml");
  fs::create_directories(folder_.path() + "/other");
  static_cast<void>(folder_.write("other/far.toml", base_text));
  static_cast<void>(folder_.write("token.toml", "token = \"geheim\"\n"));
  static_cast<void>(folder_.write("login.toml", "[scene]\nend_time = 1.0\n[geheim]\ntoken = \"geheim\"\n"));
  static_cast<void>(folder_.write("good.toml", base_text));
  static_cast<void>(folder_.write("text.toml", "geheim\n"));
  static_cast<void>(folder_.write("plain.txt", base_text));
  fs::create_symlink(folder_.path() + "/other/far.toml", folder_.path() + "/link.toml");
  fs::create_symlink("/etc/passwd", folder_.path() + "/users.toml");
  for (const std::string name : {"/etc/passwd", "../../../../../etc/passwd", "other/far.toml", "link.toml",
                                 "users.toml", "token.toml", "login.toml", "text.toml", "plain.txt", "plain",
                                 "cases", "cases/a/deep.toml", "absent.toml", "", "."}) {
    ASSERT_NO_THROW(static_cast<void>(read("extends = \"good.toml\"\n")));
    const auto what = refusal("extends = \"" + name + "\"\n");
    EXPECT_FALSE(what.empty()) << name;
    std::string here;
    try {
      static_cast<void>(read("extends = \"" + name + "\"\n[scene]\nend_time = 1.0\n"));
      ADD_FAILURE() << name;
    } catch (const InputError& e) {
      here = e.what();
    }
    EXPECT_EQ(here.find("geheim"), std::string::npos) << here;
    EXPECT_EQ(here.find("root:"), std::string::npos) << here;
  }
  EXPECT_THROW(static_cast<void>(read("extends = \"" + folder_.path() + "/good.toml\"\n")), InputError)
      << "a path of the machine";
}

TEST_F(Extends, FindsCasesBelowTheFolderOfCasesByPathAndByName) {
  const auto cases = folder_.path() + "/cases";
  fs::create_directories(cases + "/a");
  fs::create_directories(cases + "/b");
  static_cast<void>(folder_.write("cases/a/base.toml", base_text));
  for (const char* name : {"../a/base.toml", "a/base"}) {
    const auto r = read_case(folder_.write("cases/b/case.toml", std::string("extends = \"") + name + "\"\n"));
    EXPECT_EQ(r.value.scene.bodies.size(), 2U);
    EXPECT_EQ(r.value.id, "b/case");
  }
}

TEST_F(Extends, FindsTheDataOfTheOtherCaseBesideThat) {
  fs::create_directories(folder_.path() + "/cases/a");
  fs::create_directories(folder_.path() + "/cases/b");
  static_cast<void>(folder_.write("cases/a/cube.obj", "# a mesh\n"));
  static_cast<void>(folder_.write(
      "cases/a/base.toml",
      "[scene]\nend_time = 1\nspacing = 0.1\n[[body]]\nname = \"b\"\nmaterial = \"steel\"\nshape = { "
      "kind = \"mesh\", file = \"cube.obj\" }\n"));
  const auto file = folder_.write("cases/b/case.toml", "extends = \"a/base\"\n");
  try {
    const auto r = read_case(file);
    EXPECT_EQ(fs::path(r.value.scene.bodies[0].shape.file).parent_path().filename(), "a");
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("beside the case"), std::string::npos) << e.what();
  }
}

TEST_F(Extends, ChangesByTheCommandLineGoOverAll) {
  static_cast<void>(folder_.write("base.toml", base_text));
  const auto file = folder_.write("case.toml", "extends = \"base.toml\"\n[scene]\nend_time = 2\n");
  EXPECT_EQ(read_case(file, {"scene.end_time=3", "gate.1.band=[0, 9]"}).value.scene.end_time, 3.0);
  for (const char* set : {"extends=\"other.toml\"", "remove=[\"study\"]", "invariants.ledger=1",
                          "metric.place.gates=[]", "metric.place.reason=\"r\"", "gate.1.limits={1=2}"})
    EXPECT_THROW(static_cast<void>(read_case(file, {set})), InputError) << set;
}

TEST_F(Extends, TheResolvedCaseIsTheSameCase) {
  static_cast<void>(folder_.write("base.toml", base_text));
  const auto r =
      read_case(folder_.write("case.toml",
                              "extends = \"base.toml\"\n[invariants]\nmomentum = { limit = 1e-12, engine = "
                              "\"tripoint\" }\n[case]\nclaims = \"a \\\"quoted\\\" \\\\ text\"\n"));
  const auto again = read_case(folder_.write("case.toml", resolved_case(r)));
  std::string before = decisions_of(r), after = decisions_of(again);
  EXPECT_NE(before.find("metric.momentum.quantity = \"momentum\" given"), std::string::npos);
  before.erase(before.find("case.id"), before.find('\n', before.find("case.id")) - before.find("case.id"));
  after.erase(after.find("case.id"), after.find('\n', after.find("case.id")) - after.find("case.id"));
  EXPECT_EQ(before, after);
  EXPECT_EQ(r.value.id, again.value.id);
  EXPECT_EQ(resolved_case(r), resolved_case(again)) << "and its own text";
}

}  // namespace
}  // namespace tripoint::test
