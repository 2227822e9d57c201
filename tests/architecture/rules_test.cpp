// SPDX-License-Identifier: BSD-3-Clause
// Each rule on files made up here: it finds the line that breaks it, and leaves the line that does not.
#include "architecture/rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tripoint::architecture {
namespace {

Source file(std::string path, std::string text) { return {std::move(path), std::move(text)}; }

TEST(Rooms, AreReadFromPaths) {
  EXPECT_EQ(room_of("src/core/vec3.hpp"), "core");
  EXPECT_EQ(room_of("src/effects/effect.hpp"), "effects");
  EXPECT_EQ(room_of("src/effects/heat/heat.cpp"), "effects/heat");
  EXPECT_EQ(room_of("src/files/job.hpp"), "files");
  EXPECT_EQ(room_of("adapters/bullet/world.cpp"), "adapters/bullet");
  EXPECT_EQ(room_of("validation/metrics/order.hpp"), "validation/metrics");
  EXPECT_EQ(room_of("program/cli/main.cpp"), "program/cli");
  EXPECT_EQ(room_of("tests/core/vec3_test.cpp"), "");
}

/// 0 for a room of src, and one more for each folder that stands above: validation, adapters, program.
std::size_t height_of(const std::string& room) {
  const std::vector<std::string> above_src{"validation", "adapters", "program"};
  const auto at = std::ranges::find(above_src, room.substr(0, room.find('/')));
  return at == above_src.end() ? 0U : 1U + static_cast<std::size_t>(at - above_src.begin());
}

TEST(Rooms, OfAFolderIncludeNoneOfAFolderAbove) {
  EXPECT_LT(height_of("effects/heat"), height_of("validation/judge"));
  EXPECT_LT(height_of("validation/references"), height_of("adapters/exact"));
  for (const auto& [room, others] : map_of_rooms())
    for (const std::string& other : others)
      EXPECT_LE(height_of(other), height_of(room)) << room << " may include " << other;
}

/// The first room of a circle of arrows that starts at `room`; "" where there is none.
std::string circle_from(const std::string& room, std::vector<std::string>& path) {
  if (std::ranges::find(path, room) != path.end()) return room;
  path.push_back(room);
  const auto row = map_of_rooms().find(room);
  if (row != map_of_rooms().end())
    for (const auto& other : row->second)
      if (const auto found = circle_from(other, path); !found.empty()) return found;
  path.pop_back();
  return {};
}

TEST(Rooms, HaveArrowsOfOneDirection) {
  for (const auto& [room, others] : map_of_rooms()) {
    std::vector<std::string> path;
    EXPECT_EQ(circle_from(room, path), "") << "a room may include itself by way of others";
  }
}

TEST(Includes, UpTheChainAreNamedWithTheirLine) {
  const auto found = forbidden_includes(
      file("src/core/vec3.hpp", "#pragma once\n#include <cmath>\n#include \"sph/kernels.hpp\"\n"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 3U);
  EXPECT_EQ(found[0].message(),
            "src/core/vec3.hpp:3: core may not include sph\n    #include \"sph/kernels.hpp\"");
}

TEST(Includes, DownTheChainAreAllowed) {
  EXPECT_TRUE(
      forbidden_includes(
          file("src/step/step.cpp",
               "#include \"step/step.hpp\"\n#include \"assembly/plan.hpp\"\n#include \"core/vec3.hpp\"\n"))
          .empty());
  EXPECT_TRUE(forbidden_includes(
                  file("adapters/exact/exact.cpp", "#include \"validation/references/reference.hpp\"\n"))
                  .empty());
  EXPECT_TRUE(
      forbidden_includes(file("program/cli/validate.cpp",
                              "#include \"validation/campaign/suite.hpp\"\n#include \"step/step.hpp\"\n"))
          .empty());
}

TEST(Includes, OfTheJudgeNeverReachTheSolver) {
  for (const auto* room :
       {"references", "metrics", "results", "judge", "run", "campaign", "baseline", "mutation", "publish"}) {
    for (const auto* header : {"assembly/plan.hpp", "effects/heat/heat.hpp", "step/step.hpp",
                               "particles/columns.hpp", "sph/kernels.hpp"}) {
      const auto found = forbidden_includes(
          file(std::string("validation/") + room + "/a.cpp", std::string("#include \"") + header + "\"\n"));
      EXPECT_EQ(found.size(), 1U) << room << " " << header;
    }
  }
}

TEST(Includes, OfOneEffectByAnotherAreRefusedAndTheListIsNot) {
  const std::string line = "#include \"effects/heat/heat.hpp\"\n";
  EXPECT_EQ(forbidden_includes(file("src/effects/rigid/rigid.cpp", line)).size(), 1U);
  EXPECT_EQ(forbidden_includes(file("src/effects/plan.cpp", line)).size(), 1U);
  EXPECT_TRUE(forbidden_includes(file("src/effects/heat/heat.cpp", line)).empty());
  EXPECT_TRUE(forbidden_includes(file("src/assembly/all_effects.cpp", line)).empty());
}

TEST(Includes, OfOneEngineByAnotherAreRefused) {
  EXPECT_EQ(
      forbidden_includes(file("adapters/bullet/a.cpp", "#include \"adapters/lammps/deck.hpp\"\n")).size(),
      1U);
  EXPECT_EQ(forbidden_includes(file("adapters/bullet/a.cpp", "#  include \"step/step.hpp\"\n")).size(), 1U);
  EXPECT_TRUE(forbidden_includes(file("adapters/bullet/a.cpp",
                                      "#include \"world.hpp\"\n#include \"adapters/engine/engine.hpp\"\n"))
                  .empty());
}

TEST(Includes, FromARoomThatTheMapDoesNotKnowAreRefused) {
  EXPECT_EQ(forbidden_includes(file("src/shiny/new.cpp", "#include \"core/vec3.hpp\"\n")).size(), 1U);
}

TEST(Libraries, StayInTheirRooms) {
  const std::vector<std::pair<std::string, std::string>> rooms{
      {"btBulletDynamicsCommon.h", "adapters/bullet"},
      {"lammps/library.h", "adapters/lammps"},
      {"hdf5.h", "src/files"},
      {"toml++/toml.h", "src/tables"},
      {"CLI/CLI.hpp", "program/cli"}};
  for (const auto& [header, room] : rooms) {
    const std::string line = "#include <" + header + ">\n";
    EXPECT_TRUE(strayed_libraries(file(room + "/a.cpp", line)).empty()) << header;
    EXPECT_EQ(strayed_libraries(file("validation/judge/a.cpp", line)).size(), 1U) << header;
  }
  EXPECT_EQ(strayed_libraries(file("adapters/lammps/a.cpp", "#include <mpi.h>\n")).size(), 1U);
}

TEST(Libraries, ThatAreDearStayOutOfHeaders) {
  EXPECT_EQ(strayed_libraries(file("src/files/scene_json.hpp", "#include <nlohmann/json.hpp>\n")).size(), 1U);
  EXPECT_TRUE(
      strayed_libraries(file("src/files/scene_json.hpp", "#include <nlohmann/json_fwd.hpp>\n")).empty());
  EXPECT_TRUE(strayed_libraries(file("src/files/scene_json.cpp", "#include <nlohmann/json.hpp>\n")).empty());
}

}  // namespace
}  // namespace tripoint::architecture
