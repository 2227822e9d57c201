// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "files/trajectory.hpp"
#include "scene/scene.hpp"

/// Changes of a scene that physics does not feel: symmetries, and changes below the last digit. The run of
/// the changed scene, taken back, must agree with the run of the scene itself. [[harmless]] of a case names
/// those that it must bear.
namespace tripoint {

/// A scene and its particles, before or after a change.
struct ChangedScene {
  Scene scene;
  InitialState initial;
  int threads = 1;
};

/// One change and the way back from it.
struct InvarianceChange {
  std::string_view name, what;
  double tolerance;      ///< of each metric, in the metric's own scaled unit; 0 = the same bits
  std::string_view why;  ///< where the tolerance comes from
  /// Why it is no symmetry of this scene; empty = it is one.
  std::string (*refusal)(const Scene&);
  void (*apply)(ChangedScene&);
  /// Takes the frames of the changed run back to the scene that they began as (given as it was before the
  /// change).
  void (*take_back)(const ChangedScene& before, Trajectory&);
};

/// All of them, in the order of the reference page.
[[nodiscard]] const std::vector<InvarianceChange>& invariance_changes();
/// @throws InputError naming the allowed words
[[nodiscard]] const InvarianceChange& invariance_change(std::string_view name);

}  // namespace tripoint
