// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/run/instructions.hpp"

namespace tripoint {
namespace {

ProcessSpec counting(int n) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", "i=0; while [ $i -lt " + std::to_string(n) + " ]; do i=$((i+1)); done"};
  return spec;
}

TEST(Instructions, OfEveryProcessUnderCallgrindAreAddedUp) {
  EXPECT_EQ(collected_instructions("==1== Collected : 100\n==2== Collected : 23\n").value(), 123.0);
  EXPECT_FALSE(collected_instructions("==1== something else\n"));
  EXPECT_FALSE(collected_instructions("Collected : none\n"));
}

TEST(Instructions, AreTheSameInEveryRunUnderCallgrindAndGrowWithTheWork) {
  const auto once = callgrind_instructions(counting(2000)), again = callgrind_instructions(counting(2000)),
             twice = callgrind_instructions(counting(4000));
  if (!once) GTEST_SKIP() << "valgrind is not here";
  EXPECT_NEAR(*again / *once, 1.0, 1e-3);  // the shell's own start depends a little on the environment
  EXPECT_GT(*twice, 1.3 * *once);
}

TEST(Instructions, ARunThatFailsGivesNoCount) {
  ProcessSpec spec;
  spec.argv = {"/bin/sh", "-c", "exit 3"};
  EXPECT_FALSE(callgrind_instructions(spec));
}

TEST(Instructions, OfTheProcessorAreOfTheChildAloneOrNotCounted) {
  const double n = run_process(counting(100000)).instructions;
  EXPECT_TRUE(n == 0.0 || n > 1e6) << n;  // 1e5 rounds of a shell are some 1e7 instructions
}

TEST(Instructions, ThatWereNotCountedAreSaidToBeNotMeasured) {
  auto r = green();
  EXPECT_NE(results_text(r).find("\"counted_by\": \"not measured\""), std::string::npos);
  engine(r).runs[0].cost.instructions = 1e6;
  engine(r).runs[0].cost.counted_by = "callgrind";
  const TestFolder folder;
  write_text(folder / "results.json", results_text(r));
  const auto back = read_results(folder / "results.json");
  EXPECT_EQ(back.cases[0].engines[0].runs[0].cost.instructions, 1e6);
  EXPECT_EQ(back.cases[0].engines[0].runs[0].cost.counted_by, "callgrind");
}

}  // namespace
}  // namespace tripoint
