// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/shown_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "render/sphere_target.hpp"
#include "render/surface_target.hpp"
#include "surface/surface_mesh.hpp"

namespace tripoint {
namespace {

constexpr double clip = 3.0;         // sizes of the shown objects, beyond which nothing is looked at
constexpr double ball = 0.5;         // radius of a ball [spacings]
constexpr double least_span = 1e-6;  // of temperatures, for colours [K]

bool has(const Box& b) { return b.low.x <= b.high.x; }

/// The lowest height that a picture shows [m].
double lowest(const Box& b, const Vec3& up) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned c = 0; c < 8; ++c)
    least = std::min(least, dot(up, Vec3{c & 1U ? b.high.x : b.low.x, c & 2U ? b.high.y : b.low.y,
                                         c & 4U ? b.high.z : b.low.z}));
  return least;
}

Colour colour_of_row(const ShownRun& run, const Snapshot& f, std::size_t row, const Showing& s,
                     int first_liquid) {
  if (run.wall[row] != 0) return wall_colour();
  const int phase = f.phase.empty() ? 2 : f.phase[row], body = f.body.empty() ? -1 : f.body[row];
  if (s.colouring == Colouring::temperature) {
    const double share =
        f.temperature.empty() ? 0.0 : (f.temperature[row] - s.cold) / std::max(s.hot - s.cold, least_span);
    return std::isfinite(share) ? temperature_colour(share) : wall_colour();
  }
  if (s.colouring == Colouring::phase || body < 0)
    return phase_colour(phase, !f.material.empty() && f.material[row] != first_liquid);
  return body_colour(body);
}

/// The material of liquids that is coloured as such; another is lighter.
int first_liquid_of(const ShownRun& run) {
  int first = std::numeric_limits<int>::max();
  for (const Snapshot& f : run.trajectory.frames)
    for (std::size_t i = 0; i < f.position.size() && i < f.phase.size() && i < f.material.size(); ++i)
      if (f.phase[i] == 0 && f.material[i] >= 0) first = std::min(first, f.material[i]);
  return first;
}

/// Rows of a part that are drawn: no wall that hides, none that has left the picture by far.
std::vector<std::uint32_t> drawn_rows(const ShownPart& part, const Snapshot& f, const Showing& s,
                                      const Box& room, const Vec3& up, const Vec3& towards, double spacing) {
  std::vector<std::uint32_t> rows;
  for (const std::uint32_t row : part.rows)
    if (room.holds(f.position[row]) && !(part.wall && s.walls == WallsDrawn::cut && has(s.room.free) &&
                                         hides(f.position[row], s.room.free, up, towards, spacing)))
      rows.push_back(row);
  return rows;
}

std::vector<Vec3> places_of(const Snapshot& f, const std::vector<std::uint32_t>& rows) {
  std::vector<Vec3> places;
  for (const std::uint32_t row : rows) places.push_back(f.position[row]);
  return places;
}

/// Calls see(temperature, is it of a wall) for each temperature.
template <class See>
void each_temperature(const ShownRun& run, const std::vector<std::size_t>& frames, See&& see) {
  for (const std::size_t n : frames) {
    const Snapshot& f = run.trajectory.frames[n];
    for (std::size_t i = 0; i < f.temperature.size(); ++i)
      if (std::isfinite(f.temperature[i]) && is_there(f, i)) see(f.temperature[i], run.wall[i] != 0);
  }
}

}  // namespace

std::optional<std::pair<double, double>> temperatures_of(const ShownRun& run,
                                                         const std::vector<std::size_t>& frames) {
  constexpr double most = std::numeric_limits<double>::infinity();
  std::pair free{most, -most}, all{most, -most};
  each_temperature(run, frames, [&](double T, bool wall) {
    all = {std::min(all.first, T), std::max(all.second, T)};
    if (!wall) free = {std::min(free.first, T), std::max(free.second, T)};
  });
  if (free.first < free.second) return free;
  return all.first <= all.second ? std::optional(all) : std::nullopt;
}

Colouring natural_colouring(const ShownRun& run, const std::vector<std::size_t>& frames) {
  const auto T = temperatures_of(run, frames);
  if (T && T->second - T->first > 1e-3) return Colouring::temperature;
  std::set<int> phases;
  for (const std::size_t n : frames) {
    const Snapshot& f = run.trajectory.frames[n];
    for (std::size_t i = 0; i < f.phase.size(); ++i)
      if (run.wall[i] == 0 && is_there(f, i)) phases.insert(f.phase[i]);
  }
  return phases.size() > 1 ? Colouring::phase : Colouring::body;
}

std::vector<Vec3> looked_at(const ShownRun& run, const std::vector<std::size_t>& frames, const Showing& s) {
  const Vec3 up = upwards(run.gravity), towards = -CameraAxes(up, s.view).forward;
  const bool free_ones = has(s.room.free);
  const Box near =
      free_ones ? grown(s.room.free, 0.5 * norm(s.room.free.high - s.room.free.low)) : s.room.walls;
  std::vector<Vec3> places;
  for (const std::size_t n : frames) {
    const Snapshot& f = run.trajectory.frames[n];
    for (std::size_t i = 0; i < f.position.size(); ++i) {
      const bool wall = run.wall[i] != 0;
      if (!is_there(f, i) || (wall && (s.walls == WallsDrawn::hide || n != frames.front())) ||
          !(wall || !free_ones ? near : s.room.free).holds(f.position[i]))
        continue;
      if (!(wall && s.walls == WallsDrawn::cut && free_ones &&
            hides(f.position[i], s.room.free, up, towards, run.spacing)))
        places.push_back(f.position[i]);
    }
  }
  return places;
}

Picture picture_of(const ShownRun& run, const Snapshot& f, const Showing& s) {
  const Vec3 up = upwards(run.gravity);
  const Box shown = box_around(s.looked_at);
  const Camera camera(s.looked_at, run.spacing, CameraAxes(up, s.view),
                      static_cast<double>(s.width) / s.height);
  Display display;
  display.up = up;
  display.size = norm(shown.high - shown.low);
  const bool has_walls = s.walls != WallsDrawn::hide && has(s.room.walls);
  if (norm(run.gravity) > 0.0)
    display.ground =
        lowest(has_walls ? united(s.room.free, s.room.walls) : s.room.free, up) - 0.5 * run.spacing;
  const Box room = grown(shown, clip * display.size);
  const int first_liquid = first_liquid_of(run);
  for (const ShownPart& part : parts_of(run, f, s.whole)) {
    if (part.wall && s.walls == WallsDrawn::hide) continue;
    const auto rows = drawn_rows(part, f, s, room, up, camera.towards(), run.spacing);
    if (rows.empty()) continue;
    std::vector<Colour> colours;
    for (const std::uint32_t row : rows) colours.push_back(colour_of_row(run, f, row, s, first_liquid));
    const auto places = places_of(f, rows);
    if (s.particles)
      display.targets.push_back(
          std::make_unique<SphereTarget>(places, ball * run.spacing, std::move(colours)));
    else
      display.targets.push_back(std::make_unique<SurfaceTarget>(places, s.surface, std::move(colours)));
  }
  return draw(display, camera, s.width, s.height, s.threads);
}

std::vector<SurfacePart> meshes_of(const ShownRun& run, const Snapshot& f, const Showing& s, double voxel) {
  std::vector<SurfacePart> meshes;
  for (const ShownPart& part : parts_of(run, f, s.whole)) {
    if (part.wall && s.walls != WallsDrawn::show) continue;
    const ImplicitSurface surface(places_of(f, part.rows), s.surface);
    SurfacePart made;
    made.name = part.name;
    made.mesh = surface_mesh(surface, voxel, s.threads);
    const auto values = [&](const auto& column) {
      std::remove_cvref_t<decltype(column)> of;
      for (const std::uint32_t row : part.rows) of.push_back(column[row]);
      return of;
    };
    const auto& corners = made.mesh.points;
    if (!f.temperature.empty())
      made.temperature = mean_at(surface, corners, values(f.temperature), s.threads);
    made.phase = f.phase.empty() ? std::vector<int>(corners.size(), 2)
                                 : label_at(surface, corners, values(f.phase), s.threads);
    made.body = f.body.empty() ? std::vector<int>(corners.size(), -1)
                               : label_at(surface, corners, values(f.body), s.threads);
    meshes.push_back(std::move(made));
  }
  return meshes;
}

}  // namespace tripoint
