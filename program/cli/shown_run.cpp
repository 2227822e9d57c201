// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/shown_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "validation/case/engine_names.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

// Share of the free particles, at each end of each axis, that a picture may lose
constexpr double flown_off = 0.005;
constexpr std::size_t looked_at = 400;  // particles whose nearest neighbour is looked for

int at_or(const std::vector<int>& column, std::size_t row, int otherwise) {
  return row < column.size() ? column[row] : otherwise;
}

/// Up to three folders below one that hold a trajectory.
std::string runs_below(const fs::path& folder) {
  std::string found;
  std::error_code none;
  std::size_t count = 0;
  for (fs::recursive_directory_iterator at(folder, none), end; !none && at != end && count < 3;
       at.increment(none))
    if (at->path().filename() == "trajectory.h5")
      found += (count++ == 0 ? "" : ", ") + at->path().parent_path().string();
  return found;
}

fs::path folder_of(const std::string& run) {
  const fs::path path(run);
  if (fs::is_regular_file(path)) return path.parent_path().empty() ? fs::path(".") : path.parent_path();
  if (fs::exists(path / "trajectory.h5")) return path;
  if (const auto by_case = fs::path("runs") / path / engine_name::solver;
      fs::exists(by_case / "trajectory.h5"))
    return by_case;
  if (!fs::is_directory(path))
    throw InputError(fmt::format(
        "{}: no such folder, and no run of a case of this name in runs/. `tripoint run CASE` makes one",
        run));
  const auto others = runs_below(path);
  throw InputError(fmt::format(
      "{}: no trajectory.h5 here{}", run,
      others.empty() ? ". `tripoint run CASE --out DIR` leaves one in DIR" : "; there is one in " + others));
}

/// Median distance of a particle to its nearest neighbour.
double spacing_of(const Snapshot& f, const std::string& folder) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < f.position.size(); ++i)
    if (is_there(f, i)) rows.push_back(i);
  std::vector<double> nearest;
  for (std::size_t n = 0; n < rows.size(); n += std::max<std::size_t>(1, rows.size() / looked_at)) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t j : rows)
      if (j != rows[n]) least = std::min(least, norm(f.position[j] - f.position[rows[n]]));
    nearest.push_back(least);
  }
  if (nearest.size() < 2)
    throw InputError(folder + ": too few particles to tell their spacing, and no job.json that says it");
  std::ranges::nth_element(nearest, nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2));
  return nearest[nearest.size() / 2];
}

void read_job_into(ShownRun& run, const std::string& file) {
  const Job job = read_job(file);
  run.has_job = true;
  run.spacing = job.resolution.spacing;
  run.gravity = job.scene.gravity;
  for (const auto& m : job.scene.materials) run.material_names.push_back(m.name);
  std::vector<char> is_fixed;
  for (const JobBody& body : job.bodies) {
    if (body.index < 0) continue;
    const auto row = static_cast<std::size_t>(body.index);
    if (row >= run.body_names.size()) {
      run.body_names.resize(row + 1);
      is_fixed.resize(row + 1);
    }
    run.body_names[row] = body.name;
    is_fixed[row] = body.motion == Motion::fixed;
  }
  const Snapshot& first = run.trajectory.frames.front();
  for (std::size_t i = 0; i < run.wall.size() && i < first.position.size(); ++i) {
    const int body = at_or(first.body, i, -1);
    run.wall[i] = is_there(first, i) && body >= 0 && static_cast<std::size_t>(body) < is_fixed.size() &&
                  is_fixed[static_cast<std::size_t>(body)];
  }
}

/// Solids that are where they began in every frame.
void find_walls(ShownRun& run) {
  const auto& frames = run.trajectory.frames;
  const Snapshot& first = frames.front();
  for (std::size_t i = 0; i < first.position.size(); ++i) {
    bool still = is_there(first, i);
    for (const Snapshot& f : frames)
      still = still && i < f.position.size() && is_there(f, i) &&
              norm(f.position[i] - first.position[i]) < 1e-9 * run.spacing;
    run.wall[i] = still && at_or(first.body, i, -1) >= 0;
  }
}

Box without_flown_off(std::vector<Vec3>& places) {
  Box b = box_around(places);
  const auto lost = static_cast<std::size_t>(flown_off * static_cast<double>(places.size()));
  if (lost == 0) return b;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto value = [&](std::size_t n) {
      std::ranges::nth_element(places, places.begin() + static_cast<std::ptrdiff_t>(n), {},
                               [&](const Vec3& r) { return r[a]; });
      return places[n][a];
    };
    b.low[a] = value(lost);
    b.high[a] = value(places.size() - 1 - lost);
  }
  return b;
}

}  // namespace

Box united(const Box& a, const Box& b) {
  const std::vector<Vec3> corners{a.low, a.high, b.low, b.high};
  if (a.low.x > a.high.x) return b;
  return b.low.x > b.high.x ? a : box_around(corners);
}

bool is_there(const Snapshot& f, std::size_t row) {
  return (f.id.empty() || f.id[row] >= 0) && finite(f.position[row]);
}

ShownRun read_shown_run(const std::string& path) {
  ShownRun run;
  run.folder = folder_of(path).string();
  run.trajectory = read_trajectory((fs::path(run.folder) / "trajectory.h5").string());
  const auto& frames = run.trajectory.frames;
  if (frames.empty() || frames.front().position.empty())
    throw InputError(run.folder + "/trajectory.h5 holds no particles: there is nothing to draw");
  std::size_t rows = 0;
  for (const Snapshot& f : frames) rows = std::max(rows, f.position.size());
  run.wall.assign(rows, 0);
  const auto job = (fs::path(run.folder) / "job.json").string();
  if (fs::exists(job)) read_job_into(run, job);
  if (!(run.spacing > 0.0)) run.spacing = spacing_of(frames.front(), run.folder);
  if (!run.has_job) find_walls(run);
  if (std::ranges::all_of(parts_of(run, frames.front(), false), &ShownPart::wall))
    std::ranges::fill(run.wall, char{0});  // else there is nothing to look at
  return run;
}

std::vector<ShownPart> parts_of(const ShownRun& run, const Snapshot& frame, bool whole) {
  // Walls (0, body), liquids (1, material), bodies (2, body)
  std::map<std::tuple<int, int>, ShownPart> parts;
  for (std::size_t i = 0; i < frame.position.size(); ++i) {
    if (!is_there(frame, i)) continue;
    const int body = at_or(frame.body, i, -1), material = at_or(frame.material, i, 0);
    const bool wall = run.wall[i] != 0;
    const auto key = wall       ? std::tuple{0, body}
                     : whole    ? std::tuple{1, 0}
                     : body < 0 ? std::tuple{1, material}
                                : std::tuple{2, body};
    ShownPart& part = parts[key];
    if (part.rows.empty()) {
      const auto named = [](const std::vector<std::string>& names, int n, const char* kind) {
        return n >= 0 && static_cast<std::size_t>(n) < names.size() &&
                       !names[static_cast<std::size_t>(n)].empty()
                   ? names[static_cast<std::size_t>(n)]
                   : fmt::format("{} {}", kind, n);
      };
      part.wall = wall;
      part.name = whole && !wall ? "all"
                  : body < 0     ? "liquid " + named(run.material_names, material, "material")
                                 : named(run.body_names, body, "body");
    }
    part.rows.push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<ShownPart> list;
  for (auto& [key, part] : parts) list.push_back(std::move(part));
  return list;
}

ShownRoom room_for(const ShownRun& run, const std::vector<std::size_t>& frames) {
  ShownRoom room{box_around({}), box_around({})};
  for (const std::size_t n : frames) {
    const Snapshot& f = run.trajectory.frames[n];
    std::vector<Vec3> free, walls;
    for (std::size_t i = 0; i < f.position.size(); ++i)
      if (is_there(f, i)) (run.wall[i] != 0 ? walls : free).push_back(f.position[i]);
    room.free = united(room.free, without_flown_off(free));
    room.walls = united(room.walls, box_around(walls));
  }
  return room;
}

bool hides(const Vec3& place, const Box& free, const Vec3& up, const Vec3& towards, double spacing) {
  const Vec3 floor{up.x > 0.0 ? free.low.x : free.high.x, up.y > 0.0 ? free.low.y : free.high.y,
                   up.z > 0.0 ? free.low.z : free.high.z};
  if (dot(place - floor, up) < 0.0) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    if (std::abs(towards[a]) < 0.02) continue;
    const double beyond = towards[a] > 0.0 ? place[a] - free.high[a] : free.low[a] - place[a];
    if (beyond > 0.25 * spacing) return true;
  }
  return false;
}

}  // namespace tripoint
