// SPDX-License-Identifier: BSD-3-Clause
// What a hostile engine can hand back: the suite reads it with bounds, goes on, and names it.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "harness/fakes.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {

struct Hostile {
  const char* wrong;
  const char* words;  ///< of the reason
};

class HostileEngine : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileEngine, IsNamedAndNeverPasses) {
  const TestFolder folder;
  const auto c = fly(folder, GetParam().wrong, "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_missing);
  ASSERT_EQ(c.engines.size(), 1U);
  EXPECT_NE(c.engines.at(0).reason.find(GetParam().words), std::string::npos) << c.engines.at(0).reason;
}

INSTANTIATE_TEST_SUITE_P(All, HostileEngine,
                         ::testing::Values(Hostile{"deep info", "did not print one JSON object"},
                                           Hostile{"gives a number as its reason", "gives no reason"},
                                           Hostile{"gives an empty reason", "gives no reason"},
                                           Hostile{"leaves a pipe as trajectory", "no regular file"},
                                           Hostile{"leaves a pipe as result", "no regular file"},
                                           Hostile{"leaves an endless trajectory", "no regular file"},
                                           Hostile{"leaves a trajectory of 10 GB", "more than the"},
                                           Hostile{"leaves a deep result", "nests deeper"},
                                           Hostile{"leaves a trajectory that is broken within",
                                                   "cannot be read"},
                                           Hostile{"names a column twice", "twice"},
                                           Hostile{"takes all runs away", "changed while it ran"}));

TEST(HostileEngines, ALinkInPlaceOfTheLogHarmsNobody) {
  const TestFolder folder;
  write_text(folder / "victim", "precious");
  ::setenv("FAKE_VICTIM", (folder / "victim").c_str(), 1);
  const auto c = fly(folder, "leads its log elsewhere", "[engines.fake]\nrequired = true\n");
  EXPECT_EQ(c.exit_code, exit_pass) << c.engines.at(0).status << " " << c.engines.at(0).reason;
  ::unsetenv("FAKE_VICTIM");
  std::ifstream in(folder / "victim");
  std::string text;
  std::getline(in, text);
  EXPECT_EQ(text, "precious");
}

}  // namespace
}  // namespace tripoint
