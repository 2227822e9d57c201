// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// The rules of the rooms, as functions of one file's path and text: who may include whom, and where each
/// library is used.
namespace tripoint::architecture {

/// A source file: its path from the project's root with '/' between folders, and its text.
struct Source {
  std::string path, text;
};

/// One line that breaks a rule.
struct Offence {
  std::string path;
  std::size_t line = 0;  ///< from 1
  std::string text;      ///< the line itself
  std::string why;       ///< the rule, and what to do instead

  [[nodiscard]] std::string message() const;  ///< path:line: why, then the line
};

/// The lines of a text without their ends; a last line without an end counts.
[[nodiscard]] std::vector<std::string_view> lines_of(std::string_view text);

/// The room a path of src, adapters, validation or program belongs to: "core", "effects", "effects/heat",
/// "adapters", "adapters/bullet", "validation/metrics"...; "" for any other path.
[[nodiscard]] std::string room_of(std::string_view path);

/// room -> the rooms it may include beside itself.
[[nodiscard]] const std::map<std::string, std::vector<std::string>, std::less<>>& map_of_rooms();

/// Includes between rooms that the map of the rooms does not allow, and one effect that includes another.
[[nodiscard]] std::vector<Offence> forbidden_includes(const Source& source);

/// Headers of Bullet, LAMMPS, HDF5, toml++, OpenVDB, tinyobjloader and CLI11 outside their rooms, MPI
/// anywhere, and headers that are dear to compile in a header of ours.
[[nodiscard]] std::vector<Offence> strayed_libraries(const Source& source);

}  // namespace tripoint::architecture
