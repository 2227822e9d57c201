// SPDX-License-Identifier: BSD-3-Clause
// What the gates of a case leave open is a warning, and no case of the suite leaves a defect open.
#include "validation/case/preflight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fakes.hpp"
#include "validation/case/case.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

int warnings_of(const std::string& case_file, const std::string& words) {
  const auto found = unjudged(read_case(case_file).value);
  return static_cast<int>(std::ranges::count_if(found, [&](const Finding& f) {
    return !f.error && f.what.find(words) != std::string::npos && f.place.line > 0;
  }));
}

TEST(Unjudged, AMetricThatNoGateJudgesIsWarnedOf) {
  const TestFolder folder;
  const std::string metric =
      "\n[[metric]]\nname = \"way\"\nquantity = \"position\"\nnorm = \"max\"\nbody = \"cube\"\n";
  for (const auto& [gates, expected] :
       {std::pair{"", 1}, {"gates = [{ limit = 1.0, reason = \"it flies\" }]\n", 0}}) {
    write_text(folder / "one.toml", flight_case() + metric + gates);
    EXPECT_EQ(warnings_of(folder / "one.toml", "no gate judges the metric \"way\""), expected);
  }
}

TEST(Unjudged, ADefectWithAFloorAndNoCeilingIsWarnedOf) {
  const TestFolder folder;
  const auto with = [&](const std::string& edges, const std::string& reason) {
    write_text(
        folder / "one.toml",
        flight_case() +
            "\n[[metric]]\nname = \"way\"\nquantity = \"position\"\nnorm = \"max\"\nbody = \"cube\"\n" +
            "gates = [{ limit = 9.0, reason = \"of any\" }, { engine = \"tripoint\", " + edges +
            ", reason = \"" + reason + "\" }]\n");
    return warnings_of(folder / "one.toml", "is bounded from below alone");
  };
  EXPECT_EQ(with("at_least = 1.0", "known defect late: it is late"), 1);
  EXPECT_EQ(with("at_least = 1.0", "predicted defect: as printed it is late"), 1);
  EXPECT_EQ(with("band = [1.0, 2.0]", "known defect late: it is late"), 0);
  EXPECT_EQ(with("at_least = 1.0", "it must have moved"), 0);
}

TEST(Unjudged, NoCaseOfTheSuiteLeavesADefectWithoutACeiling) {
  int cases = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(TRIPOINT_SOURCE_DIR) / "cases")) {
    const auto file = entry.path().string();
    if (entry.path().extension() != ".toml" || file.find("/materials/") != std::string::npos) continue;
    ++cases;
    EXPECT_EQ(warnings_of(file, "is bounded from below alone"), 0) << file;
  }
  EXPECT_GT(cases, 200);
}

}  // namespace
}  // namespace tripoint
