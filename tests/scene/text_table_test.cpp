// SPDX-License-Identifier: BSD-3-Clause
#include "tables/text_table.hpp"

#include <gtest/gtest.h>

namespace tripoint {
namespace {

TextTable engines() {
  TextTable table({{"engine", 7}, {"error", -6, true}, {""}});
  table.add({"bullet", "0.5", "soft"});
  table.note("   it refuses ropes");
  table.add({"a longer one", "12", ""});
  return table;
}

TEST(TextTables, ForMarkdownHaveTitlesARuleAndALineARow) {
  EXPECT_EQ(engines().markdown(),
            "| engine | error | |\n|---|---:|---|\n| bullet | 0.5 | soft |\n| a longer one | 12 |  |\n");
}

TEST(TextTables, ForATerminalKeepTheWidthsOfTheirColumnsAndTheirNotes) {
  EXPECT_EQ(engines().text("  "),
            "  engine   error \n  bullet     0.5 soft\n   it refuses ropes\n  a longer one     12 \n");
}

TEST(TextTables, WithoutARowAreEmpty) {
  EXPECT_TRUE(TextTable({{"engine"}}).empty());
  EXPECT_EQ(TextTable({{"engine"}}).text(), "engine\n");
}

}  // namespace
}  // namespace tripoint
