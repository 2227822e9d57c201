// SPDX-License-Identifier: BSD-3-Clause
// The rules on the tree as it stands.
#include "architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <gtest/gtest.h>

namespace tripoint::architecture {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& path) {
  constexpr std::array<std::string_view, 5> endings{".cpp", ".hpp", ".py", ".sh", ".cmake"};
  return path.filename() == "CMakeLists.txt" || std::ranges::find(endings, path.extension().string()) != endings.end();
}

std::vector<Source> read_tree() {
  const fs::path root = TRIPOINT_SOURCE_DIR;
  std::vector<Source> sources;
  for (const auto* folder : {"src", "adapters", "validation", "program", "tests", "reports", "cmake", "tools", "python"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      sources.push_back({fs::relative(entry.path(), root).generic_string(), {std::istreambuf_iterator<char>(in), {}}});
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

TEST(Tree, NamesALicenceInEveryFile) { expect_kept(missing_licence); }

TEST(Tree, HasNoFileOverFiveHundredLines) { expect_kept(too_long); }

TEST(Tree, HoldsNoPathOfOneMachine) { expect_kept(machine_paths); }

}  // namespace
}  // namespace tripoint::architecture
