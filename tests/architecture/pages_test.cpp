// SPDX-License-Identifier: BSD-3-Clause
// The pages on the model and on the architecture: what they name is there, and what they say was measured was.
#include "architecture/pages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

#include "architecture/citations.hpp"

namespace tripoint::architecture {
namespace {

namespace fs = std::filesystem;

TEST(ArchitecturePage, HasTheMapOfTheRooms) {
  const std::string page = text_of(root() / "docs/architecture.md");
  for (const auto& [room, others] : map_of_rooms()) {
    std::string row = "| `" + room + "` | " + (others.empty() ? "nothing" : "");
    for (const std::string& other : others) row += (&other == &others.front() ? "`" : ", `") + other + "`";
    EXPECT_NE(page.find(row + " |\n"), std::string::npos) << "docs/architecture.md should have the row\n" << row << " |";
  }
}

TEST(ArchitecturePage, DrawsEveryRoom) {
  const std::string page = text_of(root() / "docs/architecture.md");
  const auto begin = page.find("```mermaid");
  const std::string picture = page.substr(begin, page.find("```\n", begin + 3) - begin);
  ASSERT_GT(picture.size(), 1000U);
  for (const auto& [room, others] : map_of_rooms()) {
    std::string name = room.substr(room.rfind('/') + 1);
    if (name == "*") name = "NAME";
    EXPECT_TRUE(std::regex_search(picture, std::regex("\\[\"[^\"]*\\b" + name + "\\b[^\"]*\"\\]")))
        << "the picture of docs/architecture.md has no box that names the room " << room;
  }
}

/// Everything that the page may name: the text of the code, and names of files.
struct Named {
  std::string code;
  std::set<std::string> files;
  std::map<std::string, std::string> stems;  ///< text of a header and its source together, by the name without its ending
};
Named named() {
  Named all;
  for (const auto* folder : {"src", "adapters", "validation", "program", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root() / folder)) {
      all.files.insert(entry.path().filename().string());
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      const std::string text = text_of(entry.path());
      all.code += text;
      all.stems[entry.path().stem().string()] += text;
    }
  }
  return all;
}

std::string last_name(const std::string& word) {
  const auto colon = word.rfind(':');
  return colon == std::string::npos ? word : word.substr(colon + 1);
}

/// "`CASE`: METRIC at LEVEL VALUE (MODE), ..." on the page.
struct Figure {
  std::string id, metric, level, value, mode;
};
std::vector<Figure> figures_of(const std::string& page) {
  static const std::regex list(
      "`([a-z]+/[a-z0-9-]+)`:((?:,?\\s+\\w+(?:\\s+at\\s+[0-9.e-]+)?\\s+(?:[0-9.e+-]+|round-off)\\s+\\((?:paper|corrected)\\))+)");
  static const std::regex one("(\\w+)(?:\\s+at\\s+([0-9.e-]+))?\\s+([0-9.e+-]+|round-off)\\s+\\((paper|corrected)\\)");
  std::vector<Figure> found;
  for (std::sregex_iterator at(page.begin(), page.end(), list), end; at != end; ++at) {
    const std::string entries = (*at)[2];
    for (std::sregex_iterator e(entries.begin(), entries.end(), one); e != end; ++e)
      found.push_back({(*at)[1], (*e)[1], (*e)[2], (*e)[3], (*e)[4]});
  }
  return found;
}

/// Values of a metric of our solver in the baseline of a case; at one level, where one is said.
std::vector<double> accepted(const Figure& f) {
  std::istringstream text(text_of(root() / "baselines" / (f.id + ".toml")));
  std::vector<double> values;
  for (std::string gate; std::getline(text, gate);) {  // one row a gate
    const auto is = [&](const std::string& key, const std::string& word) {
      return gate.find(" " + key + " = \"" + word + "\"") != std::string::npos;
    };
    const auto number = [&](const std::string& key) {
      const auto at = gate.find(" " + key + " = ");
      return at == std::string::npos ? std::nan("") : std::strtod(gate.c_str() + at + key.size() + 4, nullptr);
    };
    const bool level = f.level.empty() || std::abs(number("level") / std::stod(f.level) - 1.0) < 1e-9;
    if (is("metric", f.metric) && is("engine", "tripoint") && is("mode", f.mode) && level &&
        !std::ranges::count(values, number("value")))
      values.push_back(number("value"));  // two gates may judge one value
  }
  return values;
}

bool agree(const std::string& said, double value) {
  if (said == "round-off") return std::abs(value) < 1e-9;
  const double number = std::stod(said);
  return std::abs(number - value) <= 0.1 * std::abs(number) + 1e-12;
}

TEST(ModelPage, SaysTheFiguresThatTheBaselinesHold) {
  const std::vector<Figure> figures = figures_of(text_of(root() / "docs/model.md"));
  EXPECT_GT(figures.size(), 25U);
  for (const Figure& f : figures) {
    const std::vector<double> values = accepted(f);
    const std::string what = f.id + " " + f.metric + " (" + f.mode + ")";
    EXPECT_EQ(values.size(), 1U) << "docs/model.md: " << what << ": the baseline has " << values.size()
                                 << " such gates; say the level, or a metric that a gate judges";
    for (const double value : values)
      EXPECT_TRUE(agree(f.value, value)) << "docs/model.md says " << f.value << " of " << what << ", and its baseline " << value;
  }
  EXPECT_FALSE(agree("0.5", 0.56) || agree("round-off", 1e-6) || agree("-0.5", 0.5));
  EXPECT_TRUE(agree("0.5", 0.52) && agree("round-off", 1e-13) && agree("0", 0.0));
}

bool is_there(const std::string& word, const Named& all) {
  static const std::regex identifier("[A-Za-z_]\\w*(::[A-Za-z_]\\w*)*"), file("\\w+\\.(cpp|hpp)"),
      path("(src|adapters|validation|program|tests|docs|cases|reports|tools)/.*"), id("[a-z]+(/[a-z]+)?/[a-z0-9-]+");
  if (std::regex_match(word, path)) return fs::exists(root() / word);
  if (std::regex_match(word, id)) return fs::exists(root() / "cases" / (word + ".toml"));
  if (std::regex_match(word, file)) return all.files.contains(word);
  if (!std::regex_match(word, identifier)) return true;
  return all.code.find(last_name(word)) != std::string::npos;
}

/// Of "`f`, `g`, `src/a/b.cpp`": f and g stand in b.cpp or b.hpp. @return names that do not
std::vector<std::string> strayed(const std::string& bullet, const Named& all, std::size_t& looked_at) {
  static const std::regex name("[A-Za-z_]\\w*(::[A-Za-z_]\\w*)*"), file("(?:\\w+/)*(\\w+)\\.(?:cpp|hpp)");
  std::vector<std::string> waiting, found;
  for (const std::string& word : quoted_words(bullet)) {
    std::smatch parts;
    if (std::regex_match(word, name)) waiting.push_back(last_name(word));
    if (!std::regex_match(word, parts, file)) continue;
    const auto text = all.stems.find(parts[1]);
    for (const std::string& w : waiting)
      if (++looked_at, text == all.stems.end() || text->second.find(w) == std::string::npos) found.push_back(w + " in " + word);
    waiting.clear();
  }
  return found;
}

TEST(ModelPage, SaysTheFileThatEachFunctionStandsIn) {
  const Named all = named();
  const std::string page = text_of(root() / "docs/model.md");
  static const std::regex bullet("\\*\\*Code\\.\\*\\*([^*]*)");
  std::size_t looked_at = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), bullet), end; at != end; ++at)
    for (const std::string& name : strayed((*at)[1], all, looked_at)) ADD_FAILURE() << "docs/model.md: there is no " << name;
  EXPECT_GT(looked_at, 30U);
  EXPECT_EQ(strayed("`pressure_paper`, `src/effects/fluid/fluid.cpp`", all, looked_at).size(), 1U)
      << "it stands in equation_of_state.hpp";
}

TEST(ModelPage, NamesFilesFunctionsAndCasesThatAreThere) {
  const Named all = named();
  const std::vector<std::string> words = quoted_words(text_of(root() / "docs/model.md"));
  EXPECT_GT(words.size(), 200U);
  for (const std::string& word : words)
    EXPECT_TRUE(is_there(word, all)) << "docs/model.md names `" << word << "`, which is neither code, file nor case";
  EXPECT_FALSE(is_there("neither_code_"
                        "nor_file",
                        all) ||
               is_there("src/none.cpp", all) || is_there("fluid/none", all));
}

}  // namespace
}  // namespace tripoint::architecture
