// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/carried_density.hpp"
#include "scene/scene.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::liquid {

/// Whether an energy stands behind the pressure: its forces are the gradient of one where one kernel serves
/// density and force and the particles move with their own velocity (model 8.3). Printed (4), (7) and (9) and
/// the transport velocity have none.
[[nodiscard]] inline bool stores_compression(const Scene& scene) {
  const auto corrected = [&](const Term& one) { return scene.mode_of(one) == Mode::corrected; };
  return corrected(term::density) && corrected(term::state) && corrected(term::pressure) &&
         (!scene.transport_velocity || carries_density(scene));
}

}  // namespace tripoint::liquid
