// SPDX-License-Identifier: BSD-3-Clause
// Case files that once passed in silence, or were refused without a way out.
#include <gtest/gtest.h>

#include "case_file.hpp"
#include "sampling/sample.hpp"
#include "validation/case/preflight.hpp"

namespace tripoint::test {
namespace {

std::string with(const std::string& scene, const std::string& more = "") {
  return "[scene]\nend_time = 1.0\nspacing = 0.1\n" + scene +
         "\n[[material]]\nname='stone'\ndensity=1000\n[[body]]\nname='block'\nmaterial='stone'\nshape={kind='"
         "box',min=[0,0,0],"
         "max=[0.4,0.4,0.4]}\n" +
         more;
}

std::string refused_sample(const std::string& text) {
  try {
    static_cast<void>(sample(scene_for(read_text(text).value, {})));
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(StrangeCase, WithMoreStepsThanCanBeMadeIsRefused) {
  expect_refused(with("time_step = 1e-20"), {"case.toml:4", "scene.time_step", "1e+20 steps"});
  EXPECT_EQ(refusal(with("time_step = 1e-11")), "");
  expect_refused(with("", "[[study]]\naxis='time_step'\nlevels=[1e-2,1e-21]\n"),
                 {"study.1.levels", "1e+21 steps"});
}

TEST(StrangeCase, WithNumbersWhoseProductsAreNotFiniteIsRefused) {
  expect_refused(with("gravity = [0.0, 0.0, -1e300]"), {"scene.gravity", "up to 1e+30"});
  expect_refused("[scene]\nend_time=1\n[[material]]\nname='stone'\ndensity=1e308\n",
                 {"material.stone.density", "up to 1e+30"});
  EXPECT_EQ(refusal(with("gravity = [0.0, 0.0, -1e30]")), "");
}

TEST(StrangeCase, WithAWallLimitThatIsNoNumberIsRefused) {
  for (const char* limit : {"'x'", "0", "-3", "true"})
    expect_refused(with("", "[engines.tripoint]\nsettings={wall_limit=" + std::string(limit) + "}\n"),
                   {"wall_limit must be a number of seconds above 0"});
  EXPECT_EQ(refusal(with("", "[engines.tripoint]\nsettings={wall_limit=5}\n")), "");
}

TEST(StrangeCase, AskingForFrictionLearnsWhatThereIs) {
  expect_refused(with("", "friction = 0.3\n"),
                 {"unknown key `friction`", "pairs of materials", "[[contact]]"});
  expect_refused(with("restitution = 0.3"), {"unknown key `restitution`", "[[contact]]"});
  for (const auto& [table, answer] :
       std::vector<std::pair<std::string, std::string>>{{"revolute", "a [[joint]] of kind hinge"},
                                                        {"hinge", "a [[joint]] of kind hinge"},
                                                        {"motor", "a [[joint]] has a motor"},
                                                        {"thrust", "a [[force]] pushes a rigid body"},
                                                        {"cable", "ropes and sheets"},
                                                        {"radiation", "a [[source]] gives heat"},
                                                        {"outlet", "an [[outflow]] removes liquid"}})
    expect_refused(with("", "[[" + table + "]]\nname = 'x'\n"), {"unknown key `" + table + "`", answer});
  expect_refused(with("", "[[hose]]\nname = 'x'\n"), {"unknown key `hose`"});
}

TEST(StrangeCase, WithSomeTemperaturesLearnsOfAnInsulatingBody) {
  const std::string head =
      "[scene]\nend_time=1\nspacing=0.1\n[[material]]\nname='iron'\ndensity=1000\nconductivity=1\nheat_"
      "capacity=1\n[[material]]"
      "\nname='cork'\ndensity=1000\n";
  const std::string hot =
      "[[body]]\nname='hot'\nmaterial='iron'\nmotion='fixed'\ntemperature=400\nshape={kind='box',min=[0,0,0],"
      "max=[0.4,0.4,0.4]}"
      "\n";
  const auto cork = [](const std::string& more) {
    return "[[body]]\nname='cork'\nmaterial='cork'\nmotion='fixed'\nshape={kind='box',min=[0.4,0,0],max=[0.8,"
           "0.4,0.4]}\n" +
           more;
  };
  EXPECT_NE(refused_sample(head + hot + cork("")).find("conductivity 1e-12"), std::string::npos);
  expect_refused(head + hot + cork("temperature=300\n"), {"lacks conductivity", "1e-12 W/m/K insulates"});
  const std::string insulating = head + "conductivity=1e-12\nheat_capacity=1000\n";
  EXPECT_EQ(refused_sample(insulating + hot + cork("temperature=300\n")), "") << "what both say to do";
}

TEST(StrangeCase, WithAnEventThatCannotHappenIsRefused) {
  const auto two = [](const std::string& later) {
    return with("",
                "[[body]]\nname='other'\nmaterial='stone'\nshape={kind='box',min=[1,0,0],max=[1.4,0.4,0.4]}"
                "\n[[event]]\nkind='"
                "merge'\ntime=0.1\nbodies=['block','other']\n" +
                    later);
  };
  EXPECT_EQ(refusal(two("")), "");
  expect_refused(two("[[event]]\nkind='hold'\ntime=0.2\nbodies=['other']\n"),
                 {"body \"other\" is absorbed by a merge at 0.1 s"});
  expect_refused(with("", "[[event]]\nkind='heat'\ntime=0.1\ntemperature=400\nbodies=['block']\n"),
                 {"no body has a temperature"});
  expect_refused(with("",
                      "[[inflow]]\nmaterial='stone'\nvelocity=[1,0,0]\nstart=5\nstop=6\nshape={kind='box',"
                      "min=[1,0,0],max=[1.1,0.4,0.4]}\n"),
                 {"nothing flows in before end_time"});
}

TEST(StrangeCase, WithASpinThatMovesNoParticleIsRefused) {
  const auto chain = [](const std::string& max, const std::string& spin) {
    return "[scene]\nend_time=1\nspacing=0.1\n[[material]]\nname='stone'\ndensity=1000\n[[body]]\nname='"
           "chain'\nmaterial='stone'"
           "\nangular_velocity=" +
           spin + "\nshape={kind='box',min=[0,0,0],max=" + max + "}\n";
  };
  EXPECT_NE(refused_sample(chain("[0.5,0.1,0.1]", "[1,0,2]")).find("spin about its own axis"),
            std::string::npos);
  EXPECT_EQ(refused_sample(chain("[0.5,0.1,0.1]", "[0,1,2]")), "");
  EXPECT_EQ(refused_sample(chain("[0.5,0.2,0.1]", "[1,0,2]")), "");
  EXPECT_NE(refused_sample(chain("[0.1,0.1,0.1]", "[0,0,1]")).find("one particle"), std::string::npos);
}

TEST(LibraryValues, AreToldOnceWhereATableBearsTheName) {
  const std::string body =
      "[[body]]\nname='b'\nmaterial='water'\nshape={kind='box',min=[0,0,0],max=[1,1,1]}\n";
  const auto own =
      library_values(read_text("[scene]\nend_time=1\n[[material]]\nname='water'\ndensity=900\n" + body));
  ASSERT_EQ(own.size(), 1U);
  EXPECT_NE(own[0].what.find("viscosity = 0.001"), std::string::npos) << own[0].what;
  EXPECT_EQ(own[0].what.find("density"), std::string::npos) << "that it gives itself: " << own[0].what;
  EXPECT_TRUE(library_values(read_text("[scene]\nend_time=1\n" + body)).empty()) << "asked for by name alone";
}

}  // namespace
}  // namespace tripoint::test
