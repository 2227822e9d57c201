// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "references/measured.hpp"
#include "references/scenes.hpp"
#include "validation/case/case.hpp"
#include "validation/case/preflight.hpp"
#include "validation/references/measured_table.hpp"

namespace tripoint {
namespace {

using test::DataFile;
using test::sealed;

const std::string head =
    "# Free text: nobody reads this: not even here\n# source: A. Author, Journal 1 (1952) 1\n# unit time: "
    "0.5 s\n# unit front: 2 "
    "m\n# unit depth: 0.001 m\n"
    "# uncertainty front: 2 %\n# uncertainty depth: 3\n";
const std::string data = head + "time,front,depth\n1,1.5,400\n2.5, -3 ,1e2\n";

std::string refusal(const std::string& text) {
  const DataFile file(text);
  try {
    (void)read_experiment(file.path());
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(file.path(), 0), 0u) << what;  // the file comes first
    return what.substr(file.path().size());
  }
  return "accepted";
}

TEST(Experiment, GivesItsColumnsInSiWithTheirUncertainty) {
  const DataFile file(sealed(data));
  const auto read = read_experiment(file.path());
  EXPECT_EQ(read.source, "A. Author, Journal 1 (1952) 1");
  const auto& front = read.curves.at("front");
  EXPECT_EQ(front.time, (std::vector<double>{0.5, 1.25}));
  EXPECT_EQ(front.value, (std::vector<double>{3.0, -6.0}));
  EXPECT_NEAR(front.uncertainty[0], 0.06, 1e-15);  // 2 % of the value, its size where it is negative
  EXPECT_NEAR(front.uncertainty[1], 0.12, 1e-15);
  EXPECT_NEAR(read.curves.at("depth").value[1], 0.1, 1e-15);
  EXPECT_NEAR(read.curves.at("depth").uncertainty[1], 0.003, 1e-15);  // in the column's unit
}

TEST(Experiment, IsTheSameFileWithTheLineEndsOfWindows) {
  std::string dos;
  for (const char c : sealed(data)) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(refusal(dos), "accepted");
}

TEST(Experiment, SeesAnyChangeOfNumberUnitOrSource) {
  for (const auto& [from, to] : {std::pair{"1.5", "1.6"},
                                 {"0.5 s", "0.4 s"},
                                 {"A. Author", "B. Author"},
                                 {"2 %", "1 %"},
                                 {"2.5", "2.50"}}) {
    auto text = sealed(data);
    text.replace(text.find(from), std::string(from).size(), to);
    EXPECT_NE(refusal(text).find("they changed since they were entered"), std::string::npos) << from;
  }
  EXPECT_NE(refusal(data).find("no line `# hash: ...`; of these data it is " + experiment_hash(data)),
            std::string::npos);
}

TEST(Experiment, SaysFileAndLineOfWhatIsWrong) {
  const auto says = [](const std::string& text, const std::string& place, const std::string& words) {
    const auto what = refusal(sealed(text));
    EXPECT_EQ(what.rfind(place, 0), 0u) << what;
    EXPECT_NE(what.find(words), std::string::npos) << what;
  };
  says(head + "time,front,depth\n1,2\n", ":10", "2 values where the table has 3 columns");
  says(head + "time,front,depth\n1,2,3\n\n1,2,3\n", ":12", "times must rise");
  says(head + "time,front,depth\n1,2x,3\n", ":10", "`2x` is not a number");
  says(head + "time,front,depth\n1,nan,3\n", ":10", "does not begin with a number");
  says(head + "time,front,depth\n1,,3\n", ":10", "does not begin with a number");
  says(head + "front,time\n1,2\n", ":9", "names the columns: `time`");
  says(head + "time,front,front\n1,2,3\n", ":9", "has no name of its own");
  says(head + "time,speed\n1,2\n", ":9", "no line `# unit speed: ...`");
  says("# source: x\n# unit time: 1 s\n# unit front: 1 m\ntime,front\n1,2\n", ":5",
       "no line `# uncertainty front: ...`");
  says("# unit time: -1 s\n", ":2", "a size greater than 0");
  says("# unit time: 1\n", ":2", "the SI unit's name");
  says("# uncertainty front: 2 m\n", ":2", "write a standard uncertainty");
  says("# unit time: 1 s\n# unit front: 1 m\n# uncertainty front: 0\ntime,front\n1,2\n", ": ",
       "where do the data come from?");
  says(head + "time,front,depth\n", ": ", "the table has no row");
  EXPECT_THROW((void)read_experiment("/nowhere/at/all.csv"), InputError);
}

/// Tables as digitising programs and loggers write them.
TEST(Experiment, ReadsTabsSemicolonsBlanksAndDecimalCommas) {
  const std::string above = "# source: x\n# uncertainty front: 2 %\n";
  for (const std::string table :
       {"time [ms],front [mm]\n500,1.5\n1000,2.5\n",                        // units in the header
        "time (ms);front (mm)\n500;1,5\n1000;2,5\n",                        // a German spreadsheet
        "time / ms\tfront / mm\n500\t1.5\n1000\t2.5\n",                     // tabs
        "Front of Smith, 1983\ntime [ms],front [mm]\n500,1.5\n1000,2.5\n",  // a title
        "# columns: time [ms], front [mm]\n500 1,5\n1000 2,5\n"}) {         // no header
    const DataFile file(sealed(above + table));
    const auto read = read_experiment(file.path());
    EXPECT_DOUBLE_EQ(read.curves.at("front").time[0], 0.5) << table;
    EXPECT_DOUBLE_EQ(read.curves.at("front").value[1], 0.0025) << table;
  }
}

TEST(Experiment, SaysAtOnceAllThatATableLacks) {
  const auto what = refusal("time,front\n1,2\n");
  for (const char* line :
       {"`# unit time: ...`", "`# unit front: ...`", "`# uncertainty front: ...`", "`# source: ...`"})
    EXPECT_NE(what.find(line), std::string::npos) << what;
  EXPECT_NE(refusal("1 2\n3 4\n").find("`# columns: time, ...`"), std::string::npos);
  EXPECT_NE(refusal("time [furlong],front\n1,2\n").find("furlong"), std::string::npos);
}

/// The same tables, and what flags say of them.
TEST(MeasuredTable, BecomesADataFileByFlags) {
  TableWords words;
  words.source = "a report, figure 4";
  words.uncertainties = {{"front", "2 %"}};
  for (const std::string table :
       {"t [ms],front [mm]\n500,1.5\n1000,2.5\n",
        "\xef\xbb\xbfTime (ms);front (mm)\r\n500;1,5\r\n1000;2,5\r\n",
        "Front of a dam\n# by hand\n\ntime / ms\tfront / mm\n500\t1.5\n1000\t2.5\n"}) {
    const DataFile file(reference_table("x.csv", table, words));
    const auto read = read_experiment(file.path());
    EXPECT_EQ(read.source, words.source);
    EXPECT_DOUBLE_EQ(read.curves.at("front").time[0], 0.5) << table;
    EXPECT_DOUBLE_EQ(read.curves.at("front").value[1], 0.0025) << table;
    EXPECT_DOUBLE_EQ(read.curves.at("front").uncertainty[1], 0.00005) << table;
  }
  words.columns = {"time", "front"};
  words.units = {{"time", "s"}, {"front", "cm"}};
  const DataFile file(reference_table("x.csv", "0.5, 1.5\n1.0, 2.5\n", words));  // WebPlotDigitizer
  EXPECT_DOUBLE_EQ(read_experiment(file.path()).curves.at("front").value[1], 0.025);
}

TEST(MeasuredTable, SaysInOneMessageAllThatItDoesNotSay) {
  const auto what = [](const std::string& table, const TableWords& words = {}) -> std::string {
    try {
      return reference_table("x.csv", table, words);
    } catch (const InputError& e) {
      return e.what();
    }
  };
  const auto all = what("time,front\n1,2\n");
  for (const char* flag :
       {"--unit time=UNIT", "--unit front=UNIT", "--uncertainty front='2 %'", "--source TEXT"})
    EXPECT_NE(all.find(flag), std::string::npos) << all;
  EXPECT_NE(what("1 2\n3 4\n").find("--columns time,NAME"), std::string::npos);
  EXPECT_NE(what("day [h],front [mm]\n1,2\n").find("`day`"), std::string::npos);
  EXPECT_NE(what("time [furlong],front [mm]\n1,2\n").find("furlong"), std::string::npos);
  EXPECT_NE(what("nothing\n").find("no row"), std::string::npos);
  TableWords three;
  three.columns = {"time", "a", "b"};
  EXPECT_NE(what("1 2\n3 4\n", three).find("3 columns are named"), std::string::npos);
  TableWords known;
  known.source = "x";
  known.uncertainties = {{"front", "1"}};
  EXPECT_NE(what("time [s],front [m]\n2,1\n1,1\n", known).find("must rise"), std::string::npos);
}

TEST(Experiment, IsAReferenceThatKnowsWhatItsFileHoldsAndNoMore) {
  const DataFile file(sealed(data));
  const auto block = test::block({1, 2, 3}, 1.0, 4);
  const auto measured = make_reference(test::experiment(file), block.job, block.initial);
  ASSERT_NE(measured->measured("front"), nullptr);
  EXPECT_EQ(measured->measured("speed"), nullptr);
  EXPECT_EQ(measured->measuring().axis, 0U);
  EXPECT_TRUE(measured->at(1.0).position.empty());
  EXPECT_THROW((void)make_reference(test::experiment(file, "w"), block.job, block.initial), InputError);
  EXPECT_EQ(
      with_source_of_file(test::experiment(file)).source,
      "A. Author, Journal 1 (1952) 1; standard uncertainty of depth: 3; standard uncertainty of front: 2 %");
}

TEST(Experiment, ThatGoesOnAfterTheEndOfTheRunIsNoted) {
  const DataFile file(sealed(data));  // its last time is 1.25 s
  Case value;
  value.reference = test::experiment(file);
  value.scene.end_time = 2.0;
  EXPECT_TRUE(data_after_the_end(value).empty());
  value.scene.end_time = 1.0;
  ASSERT_EQ(data_after_the_end(value).size(), 1U);
  EXPECT_NE(data_after_the_end(value)[0].what.find("go on until 1.25 s"), std::string::npos);
  value.metrics.emplace_back();
  value.metrics[0].reference = std::move(value.reference);
  value.reference = {};
  EXPECT_EQ(data_after_the_end(value).size(), 1U);
}

TEST(Experiment, IsReadBeforeAnythingRunsAlsoWhereOnlyAMetricComparesWithIt) {
  const DataFile good(sealed(data)), bad(data);
  Case value;
  value.reference = test::experiment(good);
  value.metrics.emplace_back();
  EXPECT_NO_THROW(check_data_files(value));
  value.metrics[0].reference = test::experiment(bad);
  EXPECT_THROW(check_data_files(value), InputError);
  value.metrics[0].reference = test::function("hydrostatic");
  EXPECT_NO_THROW(check_data_files(value));
  value.reference = test::experiment(bad);
  EXPECT_THROW(check_data_files(value), InputError);
  EXPECT_EQ(with_source_of_file(value.reference).source, "");
}

}  // namespace
}  // namespace tripoint
