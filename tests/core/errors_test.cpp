// SPDX-License-Identifier: BSD-3-Clause
#include "core/errors.hpp"

#include <gtest/gtest.h>

namespace tripoint {
namespace {

TEST(InputErrorText, BeginsWithItsPlaceWhereThatIsKnownAndElseWithWhatWasWrong) {
  EXPECT_STREQ(InputError({"case.toml", 3, 7}, "no such key").what(), "case.toml:3:7: no such key");
  EXPECT_STREQ(InputError({"case.toml", 0, 0}, "no such key").what(), "case.toml: no such key");
  EXPECT_STREQ(InputError({"", 0, 0}, "no such key").what(), "no such key");
  EXPECT_STREQ(InputError({"", 3, 7}, "no such key").what(), "no such key") << "a line of no file";
}

}  // namespace
}  // namespace tripoint
