// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "particles/catalogue.hpp"
#include "scene/scene.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::liquid {

/// Whether the liquids of a scene carry their density. The sum (4) and the pressure (7) are then those of
/// solids among each other.
[[nodiscard]] inline bool carries_density(const Scene& scene) {
  return scene.has_brought_form(term::pressure);
}

/// Why no pressure by the sum acts, where its effect is left out.
[[nodiscard]] inline std::string why_none_summed(const Scene& scene) {
  return carries_density(scene) ? "liquids carry their density" : "nothing flows or touches";
}

/// Tells of groups whether their particles take their pressure from the sum (4).
class SumsDensity {
 public:
  explicit SumsDensity(const Scene& scene) : of_solids_(carries_density(scene)) {}
  [[nodiscard]] bool operator()(double group) const noexcept { return !of_solids_ || group != liquid_group; }
  [[nodiscard]] bool of_solids() const noexcept { return of_solids_; }

 private:
  bool of_solids_;
};

/// Whether what takes its pressure from the sum (4) is never below zero: without a clamp solids would attract
/// each other.
[[nodiscard]] inline bool clamps(const Scene& scene) { return scene.clamps() || carries_density(scene); }

}  // namespace tripoint::liquid
