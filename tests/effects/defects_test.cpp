// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "effects/plan.hpp"

namespace tripoint {
namespace {

TEST(Defects, AreListedOnceEachWithWhatTheyBreakAndTheCaseThatSeesIt) {
  std::set<std::string> names;
  for (const DefectEntry& d : registered_defects()) {
    EXPECT_TRUE(names.insert(d.name).second) << d.name << " twice";
    EXPECT_FALSE(d.what.empty()) << d.name;
    EXPECT_NE(d.case_id.find('/'), std::string::npos) << d.name;
  }
  EXPECT_GE(names.size(), 15u);
}

TEST(Defects, AreConstantsInTheOrdinaryBuild) {
  static_assert(defect_size("heat.conductivity") == 0.0);  // compiled without TRIPOINT_DEFECTS: no name is even looked at
  SUCCEED();
}

}  // namespace
}  // namespace tripoint
