// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/carried_density.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::liquid {

[[nodiscard]] inline bool is_liquid(const Scene&, const Body& b, const Material&) {
  return b.phase == Phase::liquid;
}

/// Why the pressure of liquids is not that of an energy of compression (model 8.3) alone; "" where it is.
[[nodiscard]] inline std::string no_compression_energy(const Scene& scene) {
  if (!scene.has_liquid()) return "nothing is liquid";
  if (carries_density(scene)) return "liquids carry their density";
  if (calls_for(scene, "phase")) return "where matter melts or freezes, densities change at once";
  const std::string printed = printed_among(scene, {term::density, term::pressure, term::state});
  if (!printed.empty()) return printed;
  return scene.clamps() ? "" : "the scene does not clamp";
}

}  // namespace tripoint::liquid
