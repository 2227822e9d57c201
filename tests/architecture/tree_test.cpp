// SPDX-License-Identifier: BSD-3-Clause
// The rules of the rooms on the tree as it stands, and on the page that draws them.
#include "architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>

#include <gtest/gtest.h>

namespace tripoint::architecture {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& path) {
  constexpr std::array<std::string_view, 5> endings{".cpp", ".hpp", ".py", ".sh", ".cmake"};
  return path.filename() == "CMakeLists.txt" ||
         std::ranges::find(endings, path.extension().string()) != endings.end();
}

std::vector<Source> read_tree() {
  const fs::path root = TRIPOINT_SOURCE_DIR;
  std::vector<Source> sources;
  for (const auto* folder :
       {"src", "adapters", "validation", "program", "tests", "reports", "cmake", "tools", "python"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      sources.push_back(
          {fs::relative(entry.path(), root).generic_string(), {std::istreambuf_iterator<char>(in), {}}});
    }
  }
  std::ranges::sort(sources, {}, &Source::path);
  return sources;
}

const std::vector<Source>& tree() {
  static const auto sources = read_tree();
  return sources;
}

void expect_kept(std::vector<Offence> (*rule)(const Source&)) {
  ASSERT_GT(tree().size(), 40U) << "the tree was not found";  // else every rule would hold of nothing
  for (const auto& source : tree()) {
    for (const auto& offence : rule(source)) ADD_FAILURE() << offence.message();
  }
}

TEST(Tree, IncludesOnlyDownTheMapOfTheRooms) { expect_kept(forbidden_includes); }

TEST(Tree, KeepsEachLibraryInItsRoom) {
  ASSERT_GT(tree().size(), 40U);
  for (const auto& source : tree()) {
    if (room_of(source.path).empty()) continue;  // a test may look at a file with the library itself
    for (const auto& offence : strayed_libraries(source)) ADD_FAILURE() << offence.message();
  }
}

TEST(Tree, HasNoRoomOfMoreThanFiftyFiles) {
  constexpr int most = 50;  // C++ files; a list of peers, such as the references, may be longer
  std::map<std::string, int> files;
  for (const auto& source : tree()) {
    const auto room = room_of(source.path);
    if (source.path.ends_with("pp") && !room.empty()) ++files[room];
  }
  ASSERT_GT(files.size(), 40U);
  for (const auto& [room, count] : files) {
    if (room == "validation/references") continue;
    EXPECT_LE(count, most) << room << ": split it by subject";
  }
}

/// docs/architecture.md.
std::string page_of_rooms() {
  std::ifstream in(fs::path(TRIPOINT_SOURCE_DIR) / "docs/architecture.md", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ArchitecturePage, HasTheMapOfTheRooms) {
  const std::string page = page_of_rooms();
  for (const auto& [room, others] : map_of_rooms()) {
    std::string row = "| `" + room + "` | " + (others.empty() ? "nothing" : "");
    for (const std::string& other : others) row += (&other == &others.front() ? "`" : ", `") + other + "`";
    EXPECT_NE(page.find(row + " |\n"), std::string::npos) << "docs/architecture.md should have the row\n"
                                                          << row << " |";
  }
}

TEST(ArchitecturePage, DrawsEveryRoom) {
  const std::string page = page_of_rooms();
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

}  // namespace
}  // namespace tripoint::architecture
