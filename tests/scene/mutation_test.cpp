// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <regex>

#include "case_file.hpp"
#include "full_case.hpp"
#include "mutator.hpp"
#include "real_cases.hpp"
#include "tables/toml_node.hpp"
#include "validation/case/schema.hpp"

/// third-party files reach the reader: whatever is in them, it refuses with line and remedy, or shows what it
/// understood.
namespace tripoint::test {
namespace {

const std::vector<std::string> sources{full_case,  cosine_case, torque_free_case,
                                       board_case, six_lines,   new_case_text("my/case")};

/// The document's meaning: tables sorted by key, numbers by value.
std::string canonical(const TomlNode& n) {
  if (n.kind == TomlNode::Kind::integer) return to_toml(n) + ".";
  if (n.kind == TomlNode::Kind::real &&
      n.real == static_cast<double>(static_cast<long>(std::clamp(n.real, -1e15, 1e15))))
    return std::to_string(static_cast<long>(n.real)) + ".";
  // "3 mm" is "3mm"
  if (n.kind == TomlNode::Kind::text && !n.text.empty() && n.text[0] >= '0' && n.text[0] <= '9') {
    std::string text = n.text;
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
  }
  if (n.kind == TomlNode::Kind::array) {
    std::string text = "[";
    for (const auto& item : n.items) text += canonical(item) + ",";
    return text + "]";
  }
  if (n.kind != TomlNode::Kind::table) return to_toml(n);
  std::vector<std::string> members;
  for (const auto& [key, value] : n.members) members.push_back(key + "=" + canonical(value));
  std::sort(members.begin(), members.end());
  std::string text = "{";
  for (const auto& m : members) text += m + ",";
  return text + "}";
}

bool has_remedy(const std::string& what) {
  static const std::regex remedy(
      "did you mean|\\(known|one of|none of: |write |give |remove|rename|close |must |lacks the key|lower "
      "|raise "
      "|shorten|lengthen|choose|flatten|break |at most|at least|needs |begin with |start from|plain "
      "UTF-8|enlarge|in s\\b");
  return std::regex_search(what, remedy);
}

struct Tally {
  int refused = 0, shown = 0, neutral = 0;
};

/// One verdict a mutant; failures are recorded.
void judge(const Mutant& m, const std::string& source, Tally& tally) {
  const Folder folder;
  const auto file = folder.write("mutant.toml", m.text);
  const auto begin = std::chrono::steady_clock::now();
  try {
    const auto r = read_case(file);
    if (!source.empty() &&
        canonical(read_toml(file)) == canonical(read_toml(folder.write("source.toml", source)))) {
      ++tally.neutral;  // the change lies in a comment, a blank or the order of keys
    } else {
      ++tally.shown;
      const auto original =
          source.empty() ? std::string() : decisions_of(read_case(folder.write("mutant.toml", source)));
      EXPECT_TRUE(decisions_of(r) != original)
          << m.what << "\n was accepted and changes nothing that is shown";
    }
  } catch (const InputError& e) {
    ++tally.refused;
    const std::string what = e.what();
    EXPECT_NE(what.find("mutant.toml"), std::string::npos) << m.what << "\n" << what;
    const bool of_the_whole_file = what.find("the case` lacks") != std::string::npos ||
                                   what.find("the file is empty") != std::string::npos ||
                                   what.find("bytes; a case file has") != std::string::npos;
    EXPECT_TRUE(e.place().line > 0 || of_the_whole_file) << m.what << "\n" << what;
    EXPECT_TRUE(has_remedy(what)) << m.what << "\n" << what;
    EXPECT_LT(what.size(), 1500U) << m.what << "\n" << what;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(seconds.count(), 5.0) << m.what;
}

TEST(MutatedCases, AreRefusedWithLineAndRemedyOrShowTheChange) {
  for (const auto& s : sources) ASSERT_EQ(refusal(s), "") << s;
  Tally tally;
  const auto all = mutants(sources, 200, 20260101);
  for (std::size_t n = 0; n < all.size(); ++n) judge(all[n], sources[n % sources.size()], tally);
  RecordProperty("refused", tally.refused);
  RecordProperty("shown", tally.shown);
  EXPECT_GT(tally.refused, 80) << "the mutants are too mild to prove anything";
  EXPECT_GE(tally.shown, 15) << "the reader refuses what it should take";
  EXPECT_LT(tally.neutral, 40) << "the mutants change too little";
}

TEST(MutatedCases, HoldUnderOtherSeedsToo) {
  Tally tally;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const auto all = mutants(sources, 200, seed);
    for (std::size_t n = 0; n < all.size(); ++n) judge(all[n], sources[n % sources.size()], tally);
  }
  RecordProperty("refused", tally.refused);
  RecordProperty("shown", tally.shown);
  RecordProperty("neutral", tally.neutral);
}

TEST(ParserBreakers, AreRefusedWithLineAndRemedy) {
  Tally tally;
  for (const auto& m : parser_breakers()) judge(m, "", tally);
  EXPECT_EQ(tally.refused, static_cast<int>(parser_breakers().size()));
}

std::string names(int n) {
  std::string path = "a";
  for (int k = 1; k < n; ++k) path += ".a";
  return path;
}

/// What the reader says of a text that is no case but TOML; "" where it takes it.
std::string refusal_of_toml(const std::string& text) {
  try {
    static_cast<void>(parse_toml(text, "file.toml"));
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

int depth_of(const TomlNode& n) {
  int deepest = 0;
  for (const auto& item : n.items) deepest = std::max(deepest, depth_of(item));
  for (const auto& [key, value] : n.members) deepest = std::max(deepest, depth_of(value));
  return deepest + 1;
}

TEST(DottedKeys, AreBoundedWhereverTheyStand) {
  const std::string longer = names(14);
  for (const std::string& text : {longer + " = 1", "[" + longer + "]", "[[" + longer + "]]",
                                  "v = {" + longer + " = 1}", "v = {b = 1, " + longer + " = 1}",
                                  "v = [1.5, {" + longer + " = 1}]", "v = {b = [{" + longer + " = 1}]}"}) {
    const auto told = refusal_of_toml("w = 1\n" + text + "\n");
    EXPECT_NE(told.find("file.toml:2:"), std::string::npos) << text << "\n" << told;
    EXPECT_NE(told.find("more than 12 dots"), std::string::npos) << text << "\n" << told;
  }
}

TEST(DottedKeys, AndBracketsAreCountedTogether) {
  const std::string path = names(10);
  const auto nested = [&path](int n) {
    std::string begin, end;
    for (int k = 0; k < n; ++k) {
      begin += "{" + path + " = [";
      end += "]}";
    }
    return "v = " + begin + end + "\n";
  };
  EXPECT_EQ(refusal_of_toml(nested(2)), "");  // twice nine dots and two brackets are 22 of 24
  EXPECT_NE(refusal_of_toml(nested(3)).find("nested deeper than 24"), std::string::npos)
      << refusal_of_toml(nested(3));
}

TEST(DottedKeys, OfTablesThatExtendTheSamePathStayAsShallow) {
  const std::string value = std::string(11, '[') + "{" + names(12) + " = 1}" + std::string(11, ']');
  std::string text;
  for (int k = 0; k < 100; ++k) {
    text += "[" + names(12) + ".b" + std::to_string(k) + "]\n";
    text += names(13) + " = " + value + "\n";
  }
  // The root, 13 names of the table, 13 of its key, 11 lists in the first of them, and 12 names: all bounds
  // together allow no more.
  EXPECT_EQ(depth_of(parse_toml(text, "file.toml")), 50);
}

TEST(DottedKeys, ArePutUpWithWhereTheyAreShort) {
  std::string numbers = "1.5";
  for (int k = 0; k < 40; ++k) numbers += k % 8 == 7 ? ",\n  1.5" : ", 1.5";
  EXPECT_EQ(refusal_of_toml("v = [" + numbers + "]\n"), "");
  EXPECT_EQ(refusal_of_toml(
                "v = {a.b.c = 1.5, d.e.f = 1.5, g.h.i = [1.5, {j.k.l = 1.5}], m.n.o = 1.5, p.q.r = 1.5}\n"),
            "");
  EXPECT_EQ(refusal_of_toml("[a.b.c]\nd.e.f = [" + numbers +
                            "]\n[[a.b.g]]\nh.i = \"x.x.x.x.x.x.x.x.x.x.x.x.x.x.x\"\n"),
            "");
}

TEST(Mutants, AreTheSameForTheSameSeed) {
  const auto a = mutants(sources, 50, 7), b = mutants(sources, 50, 7), c = mutants(sources, 50, 8);
  int differ = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    EXPECT_EQ(a[n].text, b[n].text);
    differ += a[n].text != c[n].text ? 1 : 0;
  }
  EXPECT_GT(differ, 40);
}

}  // namespace
}  // namespace tripoint::test
