// SPDX-License-Identifier: BSD-3-Clause
// The map of the rooms as tables, and the two rules that read #include lines.
#include "architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace tripoint::architecture {
namespace {

/// room -> the rooms it may include beside itself. "effects" is what every effect is, "effects/*" each
/// effect's folder. A room that is not here may be included by nobody it is not listed for.
const std::map<std::string, std::vector<std::string>, std::less<>> allowed{
    {"core", {}},
    {"tables", {"core"}},
    {"mesh", {"core", "tables"}},
    {"scene", {"core", "tables", "mesh"}},
    {"sampling", {"core", "tables", "mesh", "scene"}},
    {"surface", {"core", "tables", "mesh", "scene"}},
    {"render", {"core", "surface"}},
    {"files", {"core", "tables", "scene"}},
    {"particles", {"core", "scene"}},
    {"sph", {"core", "particles"}},
    {"state", {"core", "scene", "sampling", "particles"}},
    {"pairs", {"core", "particles", "sph", "state"}},
    {"solids", {"core", "scene", "particles", "sph", "state"}},
    {"liquids", {"core", "scene", "particles", "sph", "state", "pairs"}},
    {"effects", {"core", "scene", "particles", "state", "pairs"}},
    {"effects/*",
     {"core", "tables", "scene", "sampling", "particles", "sph", "state", "pairs", "solids", "liquids",
      "effects"}},
    {"assembly", {"core", "scene", "particles", "sph", "state", "pairs", "effects", "effects/*"}},
    {"step", {"core", "scene", "sampling", "particles", "state", "pairs", "solids", "effects", "assembly"}},
    {"adapters/engine", {"core", "files"}},
    {"adapters/tripoint",
     {"core", "tables", "scene", "files", "particles", "sph", "state", "solids", "assembly", "step",
      "adapters/engine"}},
    {"adapters/bullet", {"core", "mesh", "scene", "sampling", "files", "adapters/engine"}},
    {"adapters/lammps", {"core", "scene", "sampling", "files", "adapters/engine"}},
    {"adapters/ranks",
     {"core", "tables", "scene", "files", "particles", "state", "assembly", "step", "adapters/engine",
      "adapters/tripoint"}},
    {"validation/case", {"core", "tables", "mesh", "scene", "sampling", "files"}},
    {"validation/references", {"core", "tables", "scene", "files", "validation/case"}},
    {"validation/metrics",
     {"core", "tables", "mesh", "scene", "files", "validation/case", "validation/references"}},
    {"validation/audit",
     {"core", "scene", "sampling", "files", "validation/references", "validation/metrics"}},
    {"validation/results",
     {"core", "tables", "scene", "files", "validation/case", "validation/references", "validation/metrics"}},
    {"validation/judge", {"core", "scene", "validation/case", "validation/metrics", "validation/results"}},
    {"validation/run",
     {"core", "tables", "scene", "sampling", "files", "validation/case", "validation/references",
      "validation/metrics", "validation/audit", "validation/results"}},
    {"validation/campaign",
     {"core", "tables", "scene", "sampling", "files", "validation/case", "validation/references",
      "validation/metrics", "validation/results", "validation/judge", "validation/run"}},
    {"validation/baseline",
     {"core", "tables", "scene", "files", "validation/case", "validation/results", "validation/judge",
      "validation/run", "validation/campaign"}},
    {"validation/mutation",
     {"core", "tables", "scene", "validation/case", "validation/results", "validation/judge",
      "validation/run", "validation/campaign"}},
    {"validation/publish",
     {"core", "tables", "scene", "validation/case", "validation/results", "validation/judge",
      "validation/run", "validation/campaign", "validation/baseline", "validation/mutation"}},
    {"validation/queue",
     {"core", "tables", "scene", "files", "validation/case", "validation/results", "validation/run",
      "validation/campaign"}},
    {"adapters/exact", {"core", "scene", "files", "adapters/engine", "validation/references"}},
    {"program/bench",
     {"core", "scene", "sampling", "particles", "sph", "state", "pairs", "assembly", "step",
      "validation/case"}},
    {"program/predict", {"core", "tables", "scene", "particles"}},
};
constexpr std::string_view sees_all = "program/cli";

/// A library's headers begin so, and belong to this room only, or to those of several rows ("" = nowhere).
struct Home {
  std::string_view header, room;
};
constexpr std::array homes{
    Home{"bullet/", "adapters/bullet"},
    Home{"btBullet", "adapters/bullet"},
    Home{"BulletCollision/", "adapters/bullet"},
    Home{"BulletDynamics/", "adapters/bullet"},
    Home{"LinearMath/", "adapters/bullet"},
    Home{"lammps/", "adapters/lammps"},
    Home{"lammps/", "adapters/ranks"},
    Home{"hdf5", "files"},
    Home{"H5", "files"},
    Home{"seccomp.h", "core"},
    Home{"toml++/", "tables"},
    Home{"openvdb/", "mesh"},
    Home{"openvdb/", "surface"},
    Home{"png.h", "render"},
    Home{"tiny_obj_loader", "mesh"},
    Home{"CLI/", "program/cli"},
    Home{"mpi", "adapters/ranks"},
};
/// Seconds to compile each: only in a .cpp.
constexpr std::array<std::string_view, 6> dear{"toml++/",     "nlohmann/json.hpp", "CLI/",
                                               "boost/math/", "openvdb/",          "Eigen/Eigen"};

struct Include {
  std::size_t line;
  std::string_view text, target;
  bool quoted;
};

std::optional<Include> include_of(std::string_view line, std::size_t number) {
  auto rest = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
  if (!rest.starts_with('#')) return std::nullopt;
  rest.remove_prefix(1);
  rest = rest.substr(std::min(rest.find_first_not_of(" \t"), rest.size()));
  if (!rest.starts_with("include")) return std::nullopt;
  const auto open = rest.find_first_of("\"<");
  if (open == std::string_view::npos) return std::nullopt;
  const bool quoted = rest[open] == '"';
  const auto close = rest.find(quoted ? '"' : '>', open + 1);
  if (close == std::string_view::npos) return std::nullopt;
  return Include{number, line, rest.substr(open + 1, close - open - 1), quoted};
}

std::vector<Include> includes_of(const Source& source) {
  std::vector<Include> found;
  std::size_t number = 0;
  for (const auto line : lines_of(source.text)) {
    if (const auto include = include_of(line, ++number)) found.push_back(*include);
  }
  return found;
}

/// The path from the project's root that a quoted include means; a bare name is a neighbour.
std::string path_of(std::string_view target, std::string_view includer) {
  if (target.find('/') == std::string_view::npos)
    return std::string(includer.substr(0, includer.rfind('/') + 1)).append(target);
  const bool outside_src = target.starts_with("adapters/") || target.starts_with("validation/") ||
                           target.starts_with("program/") || target.starts_with("tests/") ||
                           target.starts_with("src/");
  return outside_src ? std::string(target) : std::string("src/").append(target);
}

bool may_include(std::string_view from, std::string_view to) {
  if (from == to || from == sees_all) return true;
  const auto general = [](std::string_view room) {
    return room.starts_with("effects/") ? std::string_view("effects/*") : room;
  };
  const auto row = allowed.find(general(from));
  return row != allowed.end() && std::ranges::find(row->second, general(to)) != row->second.end();
}

}  // namespace

std::string Offence::message() const { return fmt::format("{}:{}: {}\n    {}", path, line, why, text); }

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

const std::map<std::string, std::vector<std::string>, std::less<>>& map_of_rooms() { return allowed; }

std::string room_of(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at < path.size();) {
    const auto end = std::min(path.find('/', at), path.size());
    parts.push_back(path.substr(at, end - at));
    at = end + 1;
  }
  if (parts.size() < 2) return "";
  parts.pop_back();  // the file's name
  const bool in_src = parts.front() == "src";
  constexpr std::array<std::string_view, 3> outside{"adapters", "validation", "program"};
  if (!in_src && std::ranges::find(outside, parts.front()) == outside.end()) return "";
  if (in_src) parts.erase(parts.begin());
  if (parts.empty()) return "";
  const bool has_inner_rooms = !in_src || parts.front() == "effects";
  std::string room(parts.front());
  if (has_inner_rooms && parts.size() > 1) room.append("/").append(parts[1]);
  return room;
}

std::vector<Offence> forbidden_includes(const Source& source) {
  const auto from = room_of(source.path);
  if (from.empty()) return {};
  std::vector<Offence> found;
  for (const auto& include : includes_of(source)) {
    if (!include.quoted) continue;
    const auto to = room_of(path_of(include.target, source.path));
    if (to.empty() || may_include(from, to)) continue;
    const bool between_effects = from.starts_with("effects/") && to.starts_with("effects/");
    found.push_back({source.path, include.line, std::string(include.text),
                     between_effects ? std::string("an effect includes another: they meet in fields")
                                     : fmt::format("{} may not include {}", from, to)});
  }
  return found;
}

std::vector<Offence> strayed_libraries(const Source& source) {
  const auto room = room_of(source.path);
  const bool is_header = source.path.ends_with(".hpp");
  std::vector<Offence> found;
  for (const auto& include : includes_of(source)) {
    const auto offend = [&](std::string why) {
      found.push_back({source.path, include.line, std::string(include.text), std::move(why)});
    };
    const auto is_of = [&](std::string_view prefix) { return include.target.starts_with(prefix); };
    std::string rooms;
    bool nowhere = false, at_home = include.quoted;
    for (const auto& home : homes) {
      if (!is_of(home.header)) continue;
      nowhere = nowhere || home.room.empty();
      at_home = at_home || room == home.room;
      rooms += (rooms.empty() ? "" : " and ") + std::string(home.room);
    }
    if (nowhere && !at_home)
      offend("used nowhere: one process an engine, and no MPI");
    else if (!rooms.empty() && !at_home)
      offend(fmt::format("belongs to {} only", rooms));
    if (is_header && std::ranges::any_of(dear, is_of))
      offend("seconds to compile: include it in a .cpp only");
  }
  return found;
}

}  // namespace tripoint::architecture
