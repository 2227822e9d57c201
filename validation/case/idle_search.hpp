// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "scene/geometry.hpp"
#include "scene/initial_state.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"

/// The parts of idle_keys(), one a subject, and their common data.
namespace tripoint {

/// A case that is searched for entries without effect, and the findings so far.
struct IdleSearch {
  IdleSearch(const CaseReading&, const Scene&, const InitialState&);

  void error(const SourcePlace& place, std::string what) {
    findings.push_back({true, std::move(what), place});
  }
  void warn(const SourcePlace& place, std::string what) {
    findings.push_back({false, std::move(what), place});
  }

  /// Where the file says this key; a place without file where it does not.
  [[nodiscard]] SourcePlace given(const std::string& key) const;
  [[nodiscard]] bool any_mode(const auto& test) const { return std::ranges::any_of(scenes, test); }
  [[nodiscard]] bool calls(std::string_view effect) const;
  [[nodiscard]] std::string why_idle(std::string_view effect) const;
  /// Whether the box lies wholly beyond a side of the domain that is not periodic.
  [[nodiscard]] bool outside(const Bounds& box) const;
  /// Keyframes that come after the end of the run.
  void keyframes(const std::vector<Keyframe>& frames, const std::string& whose, const SourcePlace& place);

  const CaseReading& reading;
  const Case& value;
  const Scene& scene;
  const InitialState& state;
  std::vector<Scene> scenes;  ///< one a mode of the case
  std::vector<Finding> findings;
};

/// Events whose region is empty, releases of free bodies, holds of fixed bodies.
void find_idle_events(IdleSearch&);
/// Bodies and inflows out of the domain, joints of bodies that cannot be joined, keys of a body for effects
/// that are off.
void find_idle_bodies(IdleSearch&);
/// Keys of materials and of the scene that no effect reads.
void find_idle_effect_keys(IdleSearch&);
/// References, windows and seeds that no metric reads, and gates that cannot fail or cannot pass.
void find_idle_judgement(IdleSearch&);

}  // namespace tripoint
