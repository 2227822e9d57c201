// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "state/state.hpp"

/// Which particles are one body, and which bodies hold together: connected components over bonds (model 8.9).
namespace tripoint {

/// Bonds shorter than this at their reference connect; longer ones would bridge a molten layer [m].
[[nodiscard]] inline double joining_distance(const Scene& scene) {
  return scene.merge_distance * scene.spacing;
}

/// Bodies and particles that may have come apart or grown together in this step.
struct ChangedBodies {
  std::vector<std::size_t> bodies;  ///< rows of bodies that lost or gained bonds, or lost members
  /// Ids that became solid: of the right phase and with their bonds, and as yet of no body
  std::vector<std::uint32_t> frozen;
};

/// Called once for each particle whose list of bonds is about to lose some, in order of id, while all lists
/// are still as before.
using BeforeRelisting = std::function<void(std::uint32_t id)>;

/// Makes one body of each connected component of the changed bodies and of frozen particles, and records it
/// in State::change.
/// - Bonds shorter than joining_distance() connect members of one body, and frozen particles with bodies of
/// their kind. Rigid
///   ones (all that move as one) join rigid ones, deformable ones join deformable ones. Two bodies that were
///   solid before become one only through frozen particles.
/// - Members of a rigid body whose material never melts hold together, with bonds or without.
/// - A body's row stays with the component that has most of its members; of equals, the one with the lowest
/// id. For a fixed or
///   prescribed body only members that the scene gave it count. A component that could keep several rows
///   keeps the driven one, else that of most members. Two driven bodies never unite. Other components become
///   new free bodies, "<parent>.<n>", in order of their lowest id.
/// - Longer bonds, and excluded pairs, of different components end, unless the two are joined by a shorter
/// bond (rigid with deformable). The cost is that of the changed bodies, and of one look at the column of
/// bodies.
/// @param before computed ahead of the changes to lists of bonds, so that the caller can accumulate the
/// energy let go; may be empty
void regroup(State&, const ChangedBodies&, const BeforeRelisting& before);

/// Objects of which the solids are made: bodies that bonds of any length hold together, rigid with deformable
/// ones, are one object.
[[nodiscard]] std::size_t count_objects(const State&);

/// Ids or rows in order, each once.
template <class T>
void sort_once(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace tripoint
