// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/fakes.hpp"
#include "harness/judged.hpp"
#include "validation/baseline/history.hpp"

namespace tripoint {
namespace {

using Json = nlohmann::json;

std::vector<Json> lines_of(const std::string& file) {
  std::ifstream in(file);
  std::vector<Json> list;
  for (std::string line; std::getline(in, line);) list.push_back(Json::parse(line));
  return list;
}

Results measured_value(double v) {
  auto r = green();
  error(r).value = v;
  judge(r);
  r.date = "2026-11-21T12:00:00Z";
  r.tool.commit = "abc";
  return r;
}

TEST(History, IsOnlyEverAppendedToAndHoldsValueShareAndVerdict) {
  const TestFolder folder;
  const auto file = folder / "new/history.jsonl";
  append_history(file, history_lines(measured_value(0.05)));
  append_history(file, acceptance_lines(measured_value(0.05), {}, {"2026-11-21", "abc", "because"}));
  append_history(file, history_lines(measured_value(0.2)));
  const auto lines = lines_of(file);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0]["gates"][0]["value"], 0.05);
  EXPECT_EQ(lines[0]["gates"][0]["used"], 0.5);
  EXPECT_EQ(lines[1]["accepted"], "because");
  EXPECT_EQ(lines[2]["verdict"], "FAIL");
  EXPECT_EQ(lines[2]["case"], "test/one");
}

TEST(History, AValueThatIsNotFiniteIsNullAndNoNumber) {
  const auto line = Json::parse(history_lines(measured_value(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(line["gates"][0]["value"].is_null());
  EXPECT_EQ(line["verdict"], "FAIL");
}

TEST(History, LiesWhereTheResultsSay) {
  Results r;
  EXPECT_EQ(history_file(r, "a/results.json"), "");
  r.history = "../kept/history.jsonl";
  EXPECT_EQ(history_file(r, "a/b/results.json"), "a/kept/history.jsonl");
}

TEST(History, ThatCannotBeWrittenIsAnErrorByName) {
  const TestFolder folder;
  write_text(folder / "file", "");
  EXPECT_ANY_THROW(append_history(folder / "file/history.jsonl", "{}\n"));
}

}  // namespace
}  // namespace tripoint
