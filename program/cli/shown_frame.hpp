// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "program/cli/shown_run.hpp"
#include "render/draw.hpp"
#include "render/picture.hpp"
#include "surface/implicit_surface.hpp"
#include "surface/mesh_files.hpp"

namespace tripoint {

enum class Colouring { temperature, phase, body };
enum class WallsDrawn { cut, show, hide };

/// Choices that all pictures of one run share, so that a film is steady.
struct Showing {
  Colouring colouring = Colouring::phase;
  WallsDrawn walls = WallsDrawn::cut;
  bool particles = false;  ///< balls instead of surfaces
  bool whole = false;      ///< one surface about all that is no wall
  SurfaceOptions surface;
  View view;
  int width = 640, height = 480;
  double cold = 0.0, hot = 1.0;  ///< temperatures at the ends of the colours [K]
  ShownRoom room;
  std::vector<Vec3> looked_at;  ///< room that the camera has in the picture [m]
  int threads = 1;
};

/// Default colouring of a run: temperature where it varies, else phase where there are several, else body.
[[nodiscard]] Colouring natural_colouring(const ShownRun&, const std::vector<std::size_t>& frames);

/// Least and greatest temperature of all but walls; of everything where that has none or one only; nothing
/// without temperatures [K].
[[nodiscard]] std::optional<std::pair<double, double>> temperatures_of(
    const ShownRun&, const std::vector<std::size_t>& frames);

/// Places that pictures of these frames should hold: free particles, and walls that are shown and no more
/// than half their size off.
[[nodiscard]] std::vector<Vec3> looked_at(const ShownRun&, const std::vector<std::size_t>& frames,
                                          const Showing&);

[[nodiscard]] Picture picture_of(const ShownRun&, const Snapshot&, const Showing&);

/// Meshes of the frame's parts, walls left out unless they are shown, each with what its corners know of the
/// particles.
/// @param voxel [m]
[[nodiscard]] std::vector<SurfacePart> meshes_of(const ShownRun&, const Snapshot&, const Showing&,
                                                 double voxel);

}  // namespace tripoint
