// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/escaped_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "harness/judged.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/judge/remarks.hpp"
#include "validation/publish/report_files.hpp"

namespace tripoint {
namespace {

constexpr const char* hostile =
    "x\n::error file=a.toml::forged\r\nverdict PASS exit 0\n| a | b |\n<script>alert(1)</script>\x1b[2J "
    "##[error]old @team #1 "
    "[t](https://e) `c`";

/// Results in which every name and reason that others write is hostile; red, so that all of them are printed.
Results hostile_results() {
  auto r = green();
  auto& c = r.cases[0];
  c.id = c.title = c.claims = hostile;
  r.planned = {c.id, std::string(hostile) + "2"};
  c.gates[0].metric = c.metrics[0].name = hostile;
  c.gates[0].reason = hostile;
  c.gates[0].limit = 1e-3;
  c.gates[0].place = {hostile, 7, 0};
  auto& e = c.engines[0];
  e.runs[0].metrics = {{hostile, value(0.05)}};
  e.name = e.version = e.preset = hostile;
  EngineRow other = e, gone = e;
  other.runs[0].status = Status::error;
  other.reason = other.runs[0].reason = hostile;
  gone.name = std::string(hostile) + "3";
  gone.status = Status::missing;
  gone.required = false;
  gone.runs.clear();
  c.engines = {e, other, gone};
  r.asked = {hostile};
  r.tool.commit = r.tool.compiler = r.tool.cpu = r.profile = hostile;
  judge(r);
  return r;
}

/// Lines that a runner would take for commands, and lines that look like the program's own last one.
std::vector<std::string> forged(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    const bool command = first != std::string::npos && line.compare(first, 2, "::") == 0;
    if (command || line.find("##[") != std::string::npos || line.starts_with("verdict PASS") ||
        line.find('\x1b') != std::string::npos || line.find('\r') != std::string::npos)
      found.push_back(line);
  }
  return found;
}

TEST(ForeignText, OnOneLineNothingBeginsALineTurnsOrHides) {
  EXPECT_EQ(one_line("plain \xc3\xbc \xe2\x82\xac \xf0\x9f\x99\x82"),
            "plain \xc3\xbc \xe2\x82\xac \xf0\x9f\x99\x82");
  EXPECT_EQ(one_line("a\r\nb\tc\vd\xe2\x80\xa8"
                     "e\xc2\x85"
                     "f"),
            "a  b c d e f");                                    // U+2028 and U+0085 break lines too
  EXPECT_EQ(one_line("\x1b[31m\x07\x7f\xc2\x9b"), "?[31m???");  // U+009B begins a sequence as ESC [ does
  EXPECT_EQ(one_line("a\xe2\x80\xae"
                     "b\xe2\x80\x8b"),
            "a?b?");                                   // right to left, no width
  EXPECT_EQ(one_line("\xff\xc3(\xe2\x82"), "?\?(??");  // no UTF-8
  EXPECT_EQ(one_line("\xed\xa0\x80\xf5\x80\x80\x80\xc0\x8a"),
            "?????????");  // surrogate, beyond the last letter, line feed in two bytes
}

TEST(ForeignText, InMarkdownNothingIsMarkup) {
  EXPECT_EQ(markdown("a|b<i>&amp;"), "a&#124;b&lt;i>&amp;amp;");
  EXPECT_EQ(markdown("dam_break _x_ *y* `z`"), "dam_break &#95;x&#95; &#42;y&#42; &#96;z&#96;");
  EXPECT_EQ(markdown("@team #12 a@b # c"), "@&#8203;team #&#8203;12 a@&#8203;b # c");
  EXPECT_EQ(markdown("[t](https://e.org) www.e.org"), "&#91;t&#93;(https&#58;//e.org) www&#46;e.org");
  EXPECT_EQ(markdown("rows\nof | one"), "rows of &#124; one");
}

TEST(ForeignText, InXmlAndUrlsNothingEndsAnything) {
  EXPECT_EQ(xml("a<b>\"&\x01\xff"), "a&lt;b&gt;&quot;&amp;??");
  EXPECT_EQ(url_path("cases/a b(c)/\xc3\xbc.toml"), "cases/a%20b%28c%29/%C3%BC.toml");
  EXPECT_EQ(command_text("a:b,c%\nd", true), "a%3Ab%2Cc%25%0Ad");
  EXPECT_EQ(command_text("a:b,c%\nd", false), "a:b,c%25%0Ad");
  EXPECT_EQ(command_text("a\x1b[2J ##[error]b", false), "a?[2J # #[error]b");
}

TEST(ForeignText, ALogHoldsNoCommandOfOthers) {
  EXPECT_EQ(without_commands("a\n::error::b\n  ::set-output::c\nstd::bad ##[error]d\n"),
            "a\n: :error::b\n  : :set-output::c\nstd::bad # #[error]d\n");
}

TEST(ForeignText, NoNameForgesALineOnTheTerminal) {
  const auto r = hostile_results();
  ASSERT_NE(r.exit_code, exit_pass);
  const auto remarks = verdict_remarks(r);
  ASSERT_GE(remarks.size(), 3U);
  for (const auto& text : {case_line(r.cases[0]), notes_text(r), remarks_text(remarks), last_line(r, hostile),
                           verdict_word(r.exit_code, r, remarks)}) {
    EXPECT_TRUE(forged(without_commands(text)).empty()) << text;
  }
}

TEST(ForeignText, AnAnnotationIsOneCommand) {
  const auto remarks = verdict_remarks(hostile_results());
  std::istringstream lines(annotations_text(remarks));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_TRUE(line.starts_with("::error ") || line.starts_with("::warning ")) << line;
  EXPECT_EQ(count, std::min<std::size_t>(remarks.size(), 10));
}

TEST(ForeignText, TheSummaryHoldsNoTagAndNoRowOfOthers) {
  const auto text = summary_text(hostile_results());
  EXPECT_EQ(text.find("<script>"), text.npos) << text;
  EXPECT_EQ(text.find("@team"), text.npos) << text;
  EXPECT_EQ(text.find("https://"), text.npos) << text;
  EXPECT_EQ(text.find('\x1b'), text.npos) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.empty() || line[0] == '#' || line[0] == '|' || line.starts_with("- ") ||
                line.starts_with("1 case, "))
        << line;
    const auto bars = std::count(line.begin(), line.end(), '|');
    EXPECT_EQ(bars, line.starts_with("|") ? 6 : 0) << line;
  }
}

TEST(ForeignText, JunitStaysWellFormed) {
  const auto text = junit_text(hostile_results());
  EXPECT_EQ(text.find("<script>"), text.npos);
  EXPECT_EQ(text.find('\x1b'), text.npos);
}

}  // namespace
}  // namespace tripoint
