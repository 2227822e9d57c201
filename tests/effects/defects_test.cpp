// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "assembly/plan.hpp"

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

// In the ordinary build (without TRIPOINT_DEFECTS) a defect is a constant: no name is even looked at.
static_assert(defect_size("heat.conductivity") == 0.0);

}  // namespace
}  // namespace tripoint
