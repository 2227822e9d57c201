// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "files/trajectory.hpp"
#include "render/camera.hpp"
#include "surface/point_cells.hpp"

/// A run's folder as pictures see it: its frames, its walls, and the particles that belong together.
namespace tripoint {

struct ShownRun {
  std::string folder;
  Trajectory trajectory;
  double spacing = 0.0;  ///< of the particles [m]
  Vec3 gravity;          ///< 0 where the folder has no job [m/s2]
  bool has_job = false;  ///< whether job.json says which bodies are fixed
  /// By row: a particle that belonged to a fixed body in the first frame
  std::vector<char> wall;
  /// By row of the bodies, of the materials; may be too short
  std::vector<std::string> body_names, material_names;
};

/// Reads trajectory.h5 and, where it lies beside it, job.json. Without a job the spacing is the median
/// distance of nearest neighbours, and a solid that never moves is a wall. Where all is wall, none is.
/// @param run folder of a run, its trajectory.h5, or the id of a case that `tripoint run` left in runs/
/// @throws InputError that says where runs are
[[nodiscard]] ShownRun read_shown_run(const std::string& run);

/// Whether a particle exists in a frame, at a finite place.
[[nodiscard]] bool is_there(const Snapshot&, std::size_t row);

/// Particles that have one surface: a body, a liquid of one material, or its walls.
struct ShownPart {
  std::string name;
  bool wall = false;
  std::vector<std::uint32_t> rows;
};

/// @param whole one part of all that is no wall, instead of one a body and one a liquid
/// @return parts of the particles that are alive in a frame, in the order walls, liquids, bodies
[[nodiscard]] std::vector<ShownPart> parts_of(const ShownRun&, const Snapshot&, bool whole);

/// Room that the frames show: free particles without the few that have flown off, and all walls. Both may be
/// empty (low above high).
struct ShownRoom {
  Box free, walls;
};
[[nodiscard]] ShownRoom room_for(const ShownRun&, const std::vector<std::size_t>& frames);

/// The least box around both; of an empty one and another, the other.
[[nodiscard]] Box united(const Box&, const Box&);

/// Whether a wall's particle hides free ones from the viewer. It then stands beyond their box, on a side that
/// faces the viewer, and above the floor.
[[nodiscard]] bool hides(const Vec3& place, const Box& free, const Vec3& up, const Vec3& towards,
                         double spacing);

}  // namespace tripoint
