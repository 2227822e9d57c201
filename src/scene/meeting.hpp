// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "scene/geometry.hpp"
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"

/// Which solid bodies of a scene can come to touch while it runs, by the boxes and spheres around them and
/// how these can move. Everything is rounded towards "they can": two bodies that are not named here never
/// come nearer than one spacing.
namespace tripoint {

/// Two bodies, rows of Scene::bodies, of which one at least is moved by forces.
struct Meeting {
  std::size_t a = 0, b = 0;
  /// Greatest speed at which they can approach each other, without what gravity adds on the way [m/s]
  double speed = 0.0;
};
/// Pairs of solids that can meet before the end of the run. Bodies that are joined from the start do not meet
/// each other.
[[nodiscard]] std::vector<Meeting> meetings(const Scene&);

/// Greatest speed that a body starts with or is driven at, as far as the file tells without sampling [m/s].
[[nodiscard]] double greatest_speed(const Body&);

/// Whether a box that falls freely until the end comes across another on its way. A wall that stands beside
/// it stops nothing.
[[nodiscard]] bool falls_onto(const Scene&, const Bounds& box, const Bounds& wall);

/// Box that holds a healthy run, where the scene gives no domain. It reaches twice the diagonal of the start
/// beyond its particles, and to all places that bodies are driven to or can fly to. A body with a wall below
/// it does not fall freely.
[[nodiscard]] Bounds escape_domain(const Scene&, const InitialState&);

}  // namespace tripoint
