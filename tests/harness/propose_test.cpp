// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline_propose.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/errors.hpp"
#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

TEST(Diff, HasThreeLinesOfContextAndJoinsHunksThatMeet) {
  EXPECT_EQ(unified_diff("a\nb\n", "a\nb\n"), "");
  EXPECT_EQ(unified_diff("", "x\ny\n"), "@@ -0,0 +1,2 @@\n+x\n+y\n");
  EXPECT_EQ(unified_diff("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nFIVE\n6\n7\n8\n9\n"),
            "@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+FIVE\n 6\n 7\n 8\n");
  EXPECT_EQ(unified_diff("1\n2\n3\n4\n5\n6\n", "A\n2\n3\n4\n5\nB\n"),
            "@@ -1,6 +1,6 @@\n-1\n+A\n 2\n 3\n 4\n 5\n-6\n+B\n");
  EXPECT_EQ(unified_diff("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "0\n1\n2\n3\n4\n5\n6\n7\n8\n"),
            "@@ -1,3 +1,4 @@\n+0\n 1\n 2\n 3\n@@ -6,4 +7,3 @@\n 6\n 7\n 8\n-9\n");
}

/// Green results of a case in a folder with `cases` and `baselines`.
Results results_in(const TestFolder& folder, double error) {
  auto r = green();
  r.cases[0].file = folder / "cases/test/one.toml";
  write_text(r.cases[0].file, flight_case());
  fs::create_directories(folder / "baselines");
  r.cases[0].engines[0].runs[0].metrics["error"] = value(error);
  r.date = "2026-01-02T03:04:05Z";
  r.tool.commit = "abc";
  judge(r);
  return r;
}

TEST(Propose, WritesNoBaselineAndItsPatchApplies) {
  const TestFolder folder;
  const auto file = folder / "baselines/test/one.toml";
  for (const double error : {0.05, 0.02}) {
    const auto r = results_in(folder, error);
    const auto list = proposals(r, {}, {"2026-01-02", "abc", "a reason"});
    ASSERT_EQ(list.size(), 1U);
    const bool was_there = fs::exists(file);
    EXPECT_EQ(list[0].before.empty(), !was_there);
    write_text(folder / "p.patch", patch_text(list, "report/results.json", patch_root(list[0].file), false));
    EXPECT_EQ(fs::exists(file), was_there) << "it only proposes";
    ProcessSpec git;
    git.argv = {"/usr/bin/git", "-C", folder / "", "apply", "--verbose", folder / "p.patch"};
    const auto end = run_process(git);
    ASSERT_TRUE(end.how == ProcessEnd::How::exited && end.code == 0) << end.log_tail << end.output;
    const auto b = read_baseline(file);
    EXPECT_TRUE(b.sealed);
    EXPECT_EQ(b.accepted.back().reason, "a reason");
    EXPECT_NEAR(b.gates.at(0).value, error, 1e-12);
  }
}

TEST(Propose, ABaselineThatNobodyDecidedOnIsRed) {
  const TestFolder folder;
  const auto r = results_in(folder, 0.05);
  const auto list = proposals(r, {}, {"2026-01-02", "abc", undecided_reason});
  write_text(list[0].file, list[0].after);
  bool red = false;
  for (const auto& remark : baseline_remarks(r))
    red = red || (remark.error && remark.code == exit_missing &&
                  remark.text.find("proposed, and nobody has accepted") != std::string::npos);
  EXPECT_TRUE(red);
  EXPECT_FALSE(accept(r, {}, {"2026-01-02", "abc", "somebody did"}).empty());
  for (const auto& remark : baseline_remarks(r)) EXPECT_FALSE(remark.error) << remark.text;
}

TEST(Propose, SaysTheLineThatAcceptsAndRefusesWhatIsRed) {
  const TestFolder folder;
  auto r = results_in(folder, 0.05);
  const auto text = patch_text(proposals(r, {}, {"2026-01-02", "abc", undecided_reason}),
                               "my report/results.json", folder / "", true);
  EXPECT_NE(
      text.find(
          "# tripoint gate accept --reason 'who decided what, and why' 'my report/results.json' test/one\n"),
      std::string::npos)
      << text;
  r = results_in(folder, 0.5);
  EXPECT_THROW((void)proposals(r, {}, {"2026-01-02", "abc", "a reason"}), InputError);
}

}  // namespace
}  // namespace tripoint
