// SPDX-License-Identifier: BSD-3-Clause
// Citations: how they are read on texts made up here, and that each of the tree leads somewhere.
#include "architecture/citations.hpp"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "architecture/pages.hpp"

namespace tripoint::architecture {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> targets_in(std::string text, std::string path = "src/a.hpp") {
  std::vector<std::string> list;
  for (const Citation& c : citations_of({std::move(path), std::move(text)})) list.push_back(c.target);
  return list;
}
using Words = std::vector<std::string>;

TEST(CitationReader, TakesEquationsFromProseAndNotFromCode) {
  EXPECT_EQ(targets_in("int a = f(7);  // pressure (7)\n"), Words{"eq-7"});
  EXPECT_EQ(targets_in("/// sqrt(6), O(1) and W(0) are no equations\n"), Words{});
  EXPECT_EQ(targets_in("/// liquids, (4) and (7)-(9)\n"), (Words{"eq-4", "eq-7", "eq-8", "eq-9"}));
  EXPECT_EQ(targets_in("auto a = \"(21) as printed\";\n"), Words{"eq-21"});
}

TEST(CitationReader, TakesSectionsListsAndRanges) {
  EXPECT_EQ(targets_in("/// walls (model 8.4)\n"), Words{"8-4"});
  EXPECT_EQ(targets_in("/// (model 2, 8.7)\n"), (Words{"2", "8-7"}));
  EXPECT_EQ(targets_in("/// (model 8.1-8.5)\n"), (Words{"8-1", "8-5"}));
  EXPECT_EQ(targets_in("/// a step (model 7, time)\n"), Words{"7"});
  EXPECT_EQ(targets_in("/// pressure (model 8.3), heat (8.6)\n"), (Words{"8-3", "8-6"}));
  EXPECT_EQ(targets_in("/// as the model\n  /// 8.4 says\n"), Words{"8-4"}) << "broken between two lines";
}

TEST(CitationReader, LeavesTheNumbersOfASourceToIt) {
  EXPECT_EQ(targets_in("/// poly6 [Mueller, Charypar, Gross 2003, (20)], kernel of (4)\n"),
            (Words{"source Mueller, Charypar, Gross 2003", "eq-4"}));
  EXPECT_EQ(targets_in("# [Horn 1987, 4.A], decision 006\n", "adapters/a.py"), (Words{"source Horn 1987", "decision-6"}));
  EXPECT_EQ(targets_in("a[2003] = 1;  // Fig. 5\n"), Words{"fig-5"});
  EXPECT_EQ(targets_in("auto a = \"slerp (Shoemake 1985), built 29 Sep 2021\";\n"), Words{"source Shoemake 1985"});
}

TEST(CitationReader, SaysTheLine) {
  const auto found = citations_of({"src/a.hpp", "int a;\n/// one\n/// two (7)\n"});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 3U);
}

TEST(CitationResolver, FailsWhereTheAnchorFileOrSourceIsGone) {
  const Targets all{anchors_of("<a id=\"eq-7\"></a><a id=\"8-1-mass\"></a>"), {6}, sources_of("| Horn 1987 | B. Horn |\n")};
  const auto holds = [&](std::string target) { return resolves({"", 1, std::move(target)}, all); };
  EXPECT_TRUE(holds("eq-7") && holds("8-1") && holds("decision-6") && holds("source Horn 1987"));
  EXPECT_FALSE(holds("eq-8") || holds("8-10") || holds("8") || holds("decision-7") || holds("source Horn 1988"));
}

TEST(MarkdownLinks, AreReadWithTheirAnchors) {
  const auto links = links_of("see [a](b.md#c) and [d](#e), not [f](https://g.h)\n```\n[x](y)\n```\n");
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].file + "|" + links[0].anchor, "b.md|c");
  EXPECT_EQ(links[1].file + "|" + links[1].anchor, "|e");
  EXPECT_TRUE(link_targets_of("## From top, to bottom\n").contains("from-top-to-bottom"));
}

std::vector<Source> sources() {
  std::vector<Source> list;
  for (const auto* folder : {"src", "adapters", "validation", "program", "tests", "reports", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root() / folder)) {
      const auto ending = entry.path().extension();
      if (ending != ".cpp" && ending != ".hpp" && ending != ".py") continue;
      if (entry.path().parent_path().filename() == "architecture") continue;  // texts made up for these tests
      list.push_back({fs::relative(entry.path(), root()).generic_string(), text_of(entry.path())});
    }
  }
  return list;
}

Targets targets() {
  Targets t{anchors_of(text_of(root() / "docs/model.md")), {}, sources_of(text_of(root() / "REFERENCES.md"))};
  for (const auto& entry : fs::directory_iterator(root() / "docs/decisions"))
    t.decisions.insert(std::stoi(entry.path().filename().string()));
  return t;
}

/// Pages for people, which link to each other.
std::vector<fs::path> pages() {
  std::vector<fs::path> list;
  for (const fs::path& folder : {root(), root() / "docs", root() / "docs/decisions"})
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".md") list.push_back(entry.path());
  return list;
}

TEST(Citations, LeadToTheModelTheDecisionsOrTheReferences) {
  const Targets all = targets();
  std::map<std::string, int> kinds;
  for (const Source& source : sources()) {
    for (const Citation& c : citations_of(source)) {
      const auto kind = c.target.starts_with("source")     ? "sources"
                        : c.target.starts_with("decision") ? "decisions"
                        : c.target.starts_with("eq")       ? "equations"
                                                           : "sections and figures";
      ++kinds[kind];
      EXPECT_TRUE(resolves(c, all)) << c.path << ":" << c.line
                                    << ": nothing in docs/model.md, docs/decisions or REFERENCES.md has the name " << c.target;
    }
  }
  for (const auto& [kind, count] : kinds) std::printf("citations of %s: %d\n", kind.c_str(), count);
  EXPECT_GT(kinds["equations"], 50);
  EXPECT_GT(kinds["sections and figures"], 50);
  EXPECT_GT(kinds["sources"], 15);
}

TEST(Citations, OfSourcesOnPagesAndInCasesAreInTheReferences) {
  const Targets all = targets();
  std::vector<Source> texts;
  for (const fs::path& page : pages())
    if (page.filename() != "REFERENCES.md") texts.push_back({fs::relative(page, root()).generic_string(), text_of(page)});
  for (const auto& entry : fs::recursive_directory_iterator(root() / "cases"))
    if (entry.path().extension() == ".toml")
      texts.push_back({fs::relative(entry.path(), root()).generic_string() + ".md", text_of(entry.path())});  // also in its texts
  for (const Source& text : texts)
    for (const Citation& c : citations_of(text))
      EXPECT_TRUE(!c.target.starts_with("source") || resolves(c, all))
          << text.path << ":" << c.line << ": REFERENCES.md has no " << c.target;
}

TEST(Citations, HaveEveryEquationOfThePaperOnThePage) {
  const auto anchors = targets().anchors;
  for (int n = 1; n <= 26; ++n) EXPECT_TRUE(anchors.contains("eq-" + std::to_string(n))) << n;
}

TEST(Pages, LinkToFilesAndAnchorsThatAreThere) {
  std::size_t count = 0;
  for (const fs::path& page : pages()) {
    for (const Link& link : links_of(text_of(page))) {
      ++count;
      const fs::path file = link.file.empty() ? page : page.parent_path() / link.file;
      const std::string where = fs::relative(page, root()).generic_string() + ":" + std::to_string(link.line);
      EXPECT_TRUE(fs::exists(file)) << where << ": there is no " << link.file;
      const bool leads_on = !link.anchor.empty() && fs::exists(file);
      EXPECT_TRUE(!leads_on || link_targets_of(text_of(file)).contains(link.anchor))
          << where << ": " << link.file << " has no anchor " << link.anchor;
    }
  }
  EXPECT_GT(count, 30U);
}

}  // namespace
}  // namespace tripoint::architecture
